#include "line/report/HtmlReport.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <vector>

#include "line/Format.h"
#include "line/recording/WallTime.h"
#include "line/report/SvgPlot.h"

namespace line {

namespace {

constexpr size_t StripColumns = 480;
constexpr size_t WorstMost = 10;
constexpr size_t SpansMost = 10;  // of a kind: the page must fit on a sheet

constexpr const char *Style =
    ":root{color-scheme:light dark;--page:#fff;--text:#24292f;--quiet:#57606a;--edge:#d8dee4;--good:#1a7f37;"
    "--warning:#9a6700;--bad:#cf222e;--lost:#bf8700;--failsafe:#cf222e;--silent:#6e7781;--late:#8250df;"
    "--c0:#0072b2;--c1:#c04d00;--c2:#007a5a;--c3:#a3447c}"  // Okabe and Ito's hues, darker on white, lighter on black
    "@media screen and (prefers-color-scheme:dark){:root{--page:#0d1117;--text:#e6edf3;--quiet:#8b949e;--edge:#30363d;"
    "--good:#3fb950;--warning:#d29922;--bad:#ff7b72;--lost:#e3b341;--failsafe:#ff7b72;--silent:#8b949e;--late:#bc8cff;"
    "--c0:#56b4e9;--c1:#ff8f4d;--c2:#2fc79a;--c3:#e59ac8}}@media print{body{margin:0}}"
    "body{font:15px/1.45 system-ui,sans-serif;background:var(--page);color:var(--text);max-width:960px;margin:24px "
    "auto;"
    "padding:0 16px}h1{font-size:20px;margin:0}h2{font-size:15px;margin:20px 0 6px}"
    "p{margin:4px 0}.quiet{color:var(--quiet)}.verdict{font-weight:600;border-left:6px solid;padding:6px "
    "12px;margin:12px 0}"
    ".good{border-color:var(--good)}.warning{border-color:var(--warning)}.bad{border-color:var(--bad)}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}th{text-align:left;font-weight:600}"
    "th,td{padding:2px 18px 2px 0;border-bottom:1px solid var(--edge)}td.n,th.n{text-align:right}"
    "svg{width:100%;height:auto}.strip rect{shape-rendering:crispEdges}.base{fill:var(--edge)}"
    "text{font:12px system-ui,sans-serif;fill:var(--text)}.grid{stroke:var(--edge)}"
    ".curve{stroke-width:1.2;stroke-linejoin:round;fill-opacity:.25}circle{fill:none}"
    ".c0{fill:var(--c0);stroke:var(--c0)}.c1{fill:var(--c1);stroke:var(--c1)}.c2{fill:var(--c2);stroke:var(--c2)}"
    ".c3{fill:var(--c3);stroke:var(--c3)}text.c0,text.c1,text.c2,text.c3{stroke:none;font-weight:600}"
    ".lost{fill:var(--lost)}.failsafe{fill:var(--failsafe)}.silent{fill:var(--silent)}.late{fill:var(--late)}"
    ".key i{print-color-adjust:exact;display:inline-block;width:12px;height:12px;margin:0 4px 0 "
    "14px;vertical-align:-1px}"
    "i.lost{background:var(--lost)}i.failsafe{background:var(--failsafe)}i.silent{background:var(--silent)}"
    "i.late{background:var(--late)}.columns{display:flex;flex-wrap:wrap;gap:0 48px}section{break-inside:avoid}";

// Escapes the text for HTML.
std::string escaped(const std::string &text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

const SpanName &named(FlagSpan::Kind kind) {
  return *std::find_if(std::begin(SpanNames), std::end(SpanNames),
                       [kind](const SpanName &each) { return each.kind == kind; });
}

// Returns the name at the beginning of a line.
std::string title(const SpanName &each) {
  std::string text = each.name;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// Returns "61.250 s" for less than an hour, otherwise "1:01:01.250".
std::string timeText(int64_t us) {
  const auto ms = static_cast<unsigned long long>((us < 0 ? -us : us) / 1000);
  return (us < 0 ? "-" : "") +
         (ms < 3600000 ? format("%llu.%03llu s", ms / 1000, ms % 1000)
                       : format("%llu:%02llu:%02llu.%03llu", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000));
}

std::string cell(const std::string &text) { return "<td class=\"n\">" + text + "</td>"; }

// Draws each part as a column with the square root of its losses as its height: it shows both 0.3 % and 40 %.
std::string strip(const FlightLog &flight) {
  constexpr double Height = 48, Width = 2;
  const std::vector<FlightRating> parts = stripOf(flight, StripColumns);
  std::string text = format(
      "<svg class=\"strip\" role=\"img\" aria-label=\"losses over the flight\" viewBox=\"0 0 %.0f %.0f\" "
      "preserveAspectRatio=\"none\" style=\"height:64px\">\n<rect class=\"base\" y=\"%.0f\" width=\"%.0f\" "
      "height=\"1\"/>\n",
      static_cast<double>(parts.size()) * Width, Height, Height - 1, static_cast<double>(parts.size()) * Width);
  for (size_t i = 0; i < parts.size(); i++) {
    const FlightRating &part = parts[i];
    const double share = part.failsafe || part.silent ? std::max(part.lost, 0.3) : part.late ? 0.1 : part.lost;
    const double height = std::round(std::sqrt(share) * (Height - 1) * 10) / 10;
    if (height > 0) {
      text += format(
          "<rect class=\"%s\" x=\"%.0f\" y=\"%.1f\" width=\"%.0f\" height=\"%.1f\"><title>%s: %.1f %% "
          "lost</title></rect>\n",
          named(part.kind()).colour, static_cast<double>(i) * Width, Height - 1 - height, Width, height,
          timeText(flight.shownUs(part.fromUs)).c_str(), 100 * part.lost);
    }
  }
  text += "</svg>\n<p class=\"key quiet\">" + timeText(flight.shownUs(flight.fromUs())) + " to " +
          timeText(flight.shownUs(flight.toUs()));
  for (const SpanName &each : SpanNames) {
    text += std::string("<i class=\"") + each.colour + "\"></i>" + title(each);
  }
  return text + "</p>\n";
}

std::string worst(const FlightLog &flight) {
  std::string rows;
  for (const FlightRating &part : worstSeconds(flight, WorstMost)) {
    rows += "<tr>" + cell(timeText(flight.shownUs(part.fromUs))) + cell(format("%.1f %%", 100 * part.lost)) + "<td>" +
            (part.kind() == FlagSpan::Kind::LostFrame ? "" : named(part.kind()).name) + "</td></tr>\n";
  }
  const std::string other = flight.spans(FlagSpan::Kind::Failsafe).size() +
                                        flight.spans(FlagSpan::Kind::NoPulses).size() +
                                        flight.spans(FlagSpan::Kind::NoFrames).size() >
                                    0
                                ? "other "
                                : "";
  return "<section><h2>The worst " + other + "seconds</h2>\n" +
         (rows.empty() ? "<p>No " + other + "second has a lost frame.</p>"
                       : "<table><tr><th class=\"n\">from</th><th class=\"n\">frames lost</th><th></th></tr>\n" + rows +
                             "</table>") +
         "</section>\n";
}

std::string spans(const FlightLog &flight, const SpanName &listed) {
  const std::vector<FlagSpan> all = flight.spans(listed.kind);
  if (all.empty()) {
    return {};
  }
  std::string text =
      "<section><h2>" + title(listed) +
      format(": %zu %s, %.3f s in all", all.size(), all.size() == 1 ? "time" : "times", seconds(sumUs(all))) +
      (all.size() > SpansMost ? format("; the %zu longest", SpansMost) : "") + "</h2>\n<table>";
  for (const FlagSpan &span : longest(all, SpansMost)) {
    text += "<tr>" + cell(timeText(flight.shownUs(span.fromUs))) +
            cell(span.channels != 0 ? jumpedText(span) : format("%.3f s", seconds(span.us()))) + "</tr>\n";
  }
  return text + "</table></section>\n";
}

std::string facts(const FlightLog &flight, const ReportFacts &facts) {
  const FlightCounts &counts = flight.counts();
  std::string text = "<p class=\"quiet\">" + escaped(flight.variant()) + ", " + escaped(facts.settings);
  text += facts.startUs ? ", " + wallTime(*facts.startUs).substr(0, 19).replace(10, 1, " ") + " UTC" : "";
  text += format(
      "</p>\n<p>%s long: %lu frames, %.1f a second; %lu with the lost-frame flag, %lu missing, %lu in failsafe; ",
      timeText(static_cast<int64_t>(flight.toUs() - flight.fromUs())).c_str(), counts.frames, flight.rate().perSecond(),
      counts.lostFrames, flight.rate().missing(), counts.failsafeFrames);
  return text +
         format("%lu discarded bytes, %lu character errors.</p>\n", counts.discardedBytes, counts.characterErrors);
}

std::string intervals(const FlightLog &flight) {
  std::vector<std::pair<uint64_t, unsigned long>> all;
  for (const auto &[ms, each] : flight.rate().intervals()) {
    all.emplace_back(ms, each.count);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
  all.resize(std::min(all.size(), WorstMost));
  std::sort(all.begin(), all.end());
  std::string rows;
  for (const auto &[ms, count] : all) {
    rows +=
        "<tr>" + cell(format("%llu ms", static_cast<unsigned long long>(ms))) + cell(std::to_string(count)) + "</tr>\n";
  }
  return rows.empty() ? "" : "<section><h2>Intervals between frames</h2>\n<table>" + rows + "</table></section>\n";
}

const char *classOf(FlightVerdict::Severity severity) {
  return severity == FlightVerdict::Severity::Good      ? "good"
         : severity == FlightVerdict::Severity::Warning ? "warning"
                                                        : "bad";
}

}  // namespace

std::string htmlReport(const FlightLog &flight, const ReportFacts &about) {
  const FlightVerdict verdict = verdictOf(flight);
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>" +
      escaped(about.name) + "</title>\n<style>" + Style + "</style></head>\n<body>\n<h1>" + escaped(about.name) +
      "</h1>\n";
  text += facts(flight, about);
  text += std::string("<p class=\"verdict ") + classOf(verdict.severity) + "\">" + verdict.text + "</p>\n";
  text += strip(flight) + curvesOf(flight) + "<div class=\"columns\">\n" + worst(flight);
  for (const SpanName &each : SpanNames) {
    text += spans(flight, each);
  }
  return text + intervals(flight) + "</div>\n</body></html>\n";
}

}  // namespace line

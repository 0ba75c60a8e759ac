# Reads what doctest's -r=xml prints and says of each test case "assertions,failures,name", assertions being "random" if
# `cases` (the file CASES) has it so for `program`. Fails if the end is missing, if nothing ran, if anything failed.
BEGIN {
  while ((getline line < cases) > 0) {
    split(line, word)
    if (word[1] == "random" && word[2] == program) {
      gsub(/[?]/, ".", word[3])
      gsub(/[*]/, ".*", word[3])
      random[++randoms] = "^" word[3] "$"
    }
  }
}
function attribute(name) {
  return match($0, name "=\"[^\"]*\"") ? substr($0, RSTART + length(name) + 2, RLENGTH - length(name) - 3) : ""
}
/^ *<TestCase / { name = attribute(" name") }
/^ *<OverallResultsAsserts .*test_case_success/ {
  count = attribute("successes")
  for (i = 1; i <= randoms; i++) {
    if (name ~ random[i]) { count = count > 0 ? "random" : 0 }
  }
  print count "," attribute("failures") "," name
  ran++
  bad += attribute("test_case_success") != "true"
}
/^ *<OverallResultsTestCases / {
  ended = 1
  bad += attribute("failures") != 0
}
END { exit !ended || !ran || bad }

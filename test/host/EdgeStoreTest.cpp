// The edges of a capture in bounded memory.
#include <algorithm>
#include <random>
#include <vector>

#include "doctest/doctest.h"
#include "line/capture/EdgeStore.h"

namespace {

struct Edge {
  int64_t ns;
  bool high;
  bool operator==(const Edge &other) const { return ns == other.ns && high == other.high; }
};

std::vector<Edge> edgesIn(const line::EdgeStore &store, int64_t fromNs, int64_t toNs) {
  std::vector<Edge> found;
  store.each(fromNs, toNs, [&found](int64_t ns, bool high) { found.push_back({ns, high}); });
  return found;
}

}  // namespace

TEST_CASE("of any time the store hands over the edges, and the newest one before, whatever lies between two") {
  std::mt19937 random(42);
  std::vector<Edge> edges;
  line::EdgeStore store;
  int64_t ns = -5000000;
  for (int i = 0; i < 30000; i++) {
    edges.push_back({ns, i % 2 == 0});
    store.put(ns, i % 2 == 0);
    store.put(ns, i % 2 == 0);  // no change
    ns += random() % 100 == 0 ? 3600000000000 : random() % 40000;
  }
  for (int i = 0; i < 500; i++) {
    const int64_t fromNs = edges[random() % edges.size()].ns - static_cast<int64_t>(random() % 3);
    const int64_t toNs = fromNs + 1 + static_cast<int64_t>(random() % 100000000);
    std::vector<Edge> expected;
    for (size_t k = 0; k < edges.size(); k++) {
      if (edges[k].ns < toNs && (k + 1 == edges.size() || edges[k + 1].ns > fromNs)) {
        expected.push_back(edges[k]);
      }
    }
    INFO("from ", fromNs, " to ", toNs);
    REQUIRE(edgesIn(store, fromNs, toNs) == expected);
    CHECK(store.approximateCount(fromNs, toNs) >= expected.size());
  }
  CHECK(store.isWhole());
}

TEST_CASE("32 kB keep more than 10000 edges of S.Bus, then no more, and the store says up to when it knows the wire") {
  line::EdgeStore store(32768);
  for (int i = 0; i < 100000; i++) {
    store.put(int64_t{i} * 30000, i % 2 == 0);  // a pulse of three bits
  }
  CHECK(!store.isWhole());
  CHECK(store.endNs() > 10000 * 30000);
  CHECK(store.endNs() < 20000 * 30000);
  CHECK(edgesIn(store, store.endNs(), store.endNs() + 1).size() == 1);
}

TEST_CASE("the levels of hours show silences, and which level they have") {
  line::EdgeStore store;
  int64_t ns = 0;
  for (int burst = 0; burst < 2; burst++, ns = 3600000000000) {
    for (int i = 0; i < 4000000; i++, ns += 10000) {
      store.put(ns, i % 2 == 0);
    }
  }
  uint8_t columns[100];
  store.levels(0, 3640000000000, columns, 100);
  CHECK(std::count(columns, columns + 100, 3) <= 4);
  CHECK(columns[0] == 3);
  CHECK(columns[50] == 1);
  CHECK(columns[99] == 3);
}

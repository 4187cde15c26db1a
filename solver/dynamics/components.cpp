#include "dynamics/components.h"

#include "levelset/topology.h"
#include "parallel.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace lamella {

namespace {

constexpr int least_nodes = 20;
// Spacings: from a point of the membrane to where its inside is looked for, and the nodes around
// that place among which it is.
constexpr double inwards = 0.75;
constexpr int furthest_node = 2;

int root(std::vector<int>& parent, int a) {
  while (parent[a] != a) a = parent[a] = parent[parent[a]];
  return a;
}

void join(std::vector<int>& parent, int a, int b) {
  a = root(parent, a);
  b = root(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

} // namespace

bool Succession::is_unchanged(int group) const {
  return std::ranges::count(before, group) == 1 && std::ranges::count(after, group) == 1;
}

bool Succession::is_unchanged() const {
  return before.size() == after.size() &&
         std::ranges::all_of(before, [this](int group) { return is_unchanged(group); });
}

void Components::follow(std::span<const double> phi) {
  if (!separate_) return;
  if (settled_count_ == 1 && count_components(grid_, phi) == 1) {
    count_ = 1;
    of_node_.clear();
    succession_ = {{0}, {0}};
    return;
  }
  const ComponentMap found = components_of(grid_, phi);
  // Sets: of the vesicles before, and of what is found now, where they share nodes.
  const int before = settled_count_, now = int(found.nodes.size());
  std::vector<int> parent(before + now);
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<char> is_known(now, 0);
  for (std::size_t n = 0; n < grid_.size(); n++) {
    const int old = settled_.empty() ? 0 : settled_[n], component = found.of_node[n];
    if (old < 0 || component < 0) continue;
    is_known[component] = 1;
    join(parent, old, before + component);
  }
  for (int c = 0; c < now; c++)
    if (!is_known[c]) join(parent, 0, before + c);
  succession_.before.clear();
  for (int old = 0; old < before; old++) succession_.before.push_back(root(parent, old));
  std::vector<Piece> pieces;
  for (int c = 0; c < now; c++) pieces.push_back({root(parent, before + c), found.nodes[c]});
  const std::vector<int> index = number(pieces);
  of_node_.clear();
  if (count_ == 1) return;
  of_node_.assign(grid_.size(), -1);
  for (std::size_t n = 0; n < grid_.size(); n++)
    if (found.of_node[n] >= 0) of_node_[n] = index[found.of_node[n]];
}

/// Numbers the pieces, specks like the largest of their group, and says who comes after whom.
std::vector<int> Components::number(std::vector<Piece>& pieces) {
  std::vector<int> largest(settled_count_, -1); // of each group, named after its first vesicle
  for (int c = 0; c < int(pieces.size()); c++) {
    int& most = largest[pieces[c].group];
    if (most < 0 || pieces[c].nodes > pieces[most].nodes) most = c;
  }
  std::vector<int> order;
  for (int c = 0; c < int(pieces.size()); c++)
    if (c == largest[pieces[c].group] || pieces[c].nodes >= least_nodes) order.push_back(c);
  std::ranges::stable_sort(order, {}, [&](int c) {
    const Piece& piece = pieces[c];
    return std::tuple(c == largest[piece.group] ? 0 : 1, piece.group, -piece.nodes);
  });
  std::vector<int> index(pieces.size(), -1);
  succession_.after.clear();
  for (const int c : order) {
    index[c] = int(succession_.after.size());
    succession_.after.push_back(pieces[c].group);
  }
  for (std::size_t c = 0; c < pieces.size(); c++)
    if (index[c] < 0) index[c] = index[largest[pieces[c].group]];
  count_ = std::max(1, int(order.size()));
  return index;
}

void Components::settle() {
  if (!separate_) return;
  settled_ = of_node_;
  settled_count_ = count_;
}

void Components::restore(std::vector<int> settled) {
  settled_ = std::move(settled);
  settled_count_ = settled_.empty() ? 1 : 1 + *std::ranges::max_element(settled_);
}

void Components::shift(const std::array<int, 3>& cells) {
  if (settled_.empty()) return;
  std::vector<double> labels(settled_.begin(), settled_.end());
  lamella::shift(grid_, cells, labels);
  std::ranges::transform(labels, settled_.begin(), [](double label) { return int(label); });
}

/// The node inside that is nearest to a place a little inwards.
int Components::at(const Vec3& point, const Vec3& normal) const {
  if (count_ == 1) return 0;
  Vec3 place;
  for (int d = 0; d < 3; d++) place[d] = point[d] - inwards * grid_.spacing * normal[d];
  const std::size_t middle = grid_.nearest(place);
  if (of_node_[middle] >= 0) return of_node_[middle];
  const int at[3] = {int(middle % grid_.nx()), int(middle / grid_.nx() % grid_.ny()),
                     int(middle / grid_.nx() / grid_.ny())};
  int low[3], high[3];
  for (int d = 0; d < 3; d++) {
    low[d] = std::max(0, at[d] - furthest_node);
    high[d] = std::min(grid_.nodes[d] - 1, at[d] + furthest_node);
  }
  double nearest = 1e300;
  int found = 0;
  for (int k = low[2]; k <= high[2]; k++)
    for (int j = low[1]; j <= high[1]; j++)
      for (int i = low[0]; i <= high[0]; i++) {
        const std::size_t node = grid_.index(i, j, k);
        if (of_node_[node] < 0) continue;
        double distance2 = 0;
        const Vec3 x = grid_.position(node);
        for (int d = 0; d < 3; d++) distance2 += (x[d] - place[d]) * (x[d] - place[d]);
        if (distance2 >= nearest) continue;
        nearest = distance2;
        found = of_node_[node];
      }
  return found;
}

void Components::find_entries(const NarrowBand& band) {
  of_entry_.clear();
  if (count_ == 1) return;
  of_entry_.resize(band.size());
  const ConstPoints p = band.points(), x = band.positions();
  parallel_for(band.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; s++) {
      const int own = of_node_[band.node()[s]];
      const double d = band.distance()[s];
      if (own >= 0 || d == 0) {
        of_entry_[s] = std::max(own, 0);
        continue;
      }
      of_entry_[s] = at({p.x[s], p.y[s], p.z[s]},
                        {(x.x[s] - p.x[s]) / d, (x.y[s] - p.y[s]) / d, (x.z[s] - p.z[s]) / d});
    }
  });
}

void Components::find_samples(const SurfaceGeometry& surface) {
  of_sample_.clear();
  samples_.clear();
  if (count_ == 1) return;
  samples_.resize(count_);
  of_sample_.resize(surface.size());
  for (std::size_t i = 0; i < surface.size(); i++) {
    of_sample_[i] = i < surface.entry().size() ? of_entry_[surface.entry()[i]]
                                               : at(surface.point(i), surface.normal(i));
    samples_[of_sample_[i]].push_back(int(i));
  }
}

Samples Components::samples(int component) const {
  return count_ == 1 ? Samples{} : Samples(samples_[component]);
}

} // namespace lamella

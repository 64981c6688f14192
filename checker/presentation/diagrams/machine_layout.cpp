// Order, edges, ports, gaps, tracks: in this order, each from the ones before.
#include "checker/presentation/diagrams/machine_layout.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>

#include "checker/presentation/diagrams/draw_machine.hpp"
#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "fsm/state_words.hpp"

namespace stormproof::draw {

namespace {

using Edge = MachineLayout::Edge;
using Side = Edge::Side;

constexpr std::size_t label_columns = 30;
constexpr std::size_t own_row_columns = 44;
constexpr int padding = 12;
constexpr int port_distance = 14;
constexpr int least_gap = 36;
constexpr int head_room = 84;  // above the first state: the title and the initial marker

int width_of(const std::string& text) { return text_width(text, MachineLayout::font_size); }

int widest(const std::vector<std::string>& lines) {
  int width = 0;
  for (const std::string& line : lines) width = std::max(width, width_of(line));
  return width;
}

int height_of(const std::vector<std::string>& lines) {
  return MachineLayout::line_height * static_cast<int>(lines.size());
}

class Planner {
 public:
  explicit Planner(const fsm::MachineInfo& machine) : machine_{machine} {}

  MachineLayout run() && {
    order_states();
    place_in_column();
    collect_edges();
    for (Edge& edge : layout_.edges) choose_gap(edge);
    count_ports();
    place_states();
    place_ports();
    place_tracks();
    return std::move(layout_);
  }

 private:
  /// Detours of an order: nothing for an edge to the next state, otherwise its length.
  [[nodiscard]] int cost(const std::vector<std::size_t>& order) const {
    std::vector<int> position(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
    int sum = 0;
    for (const fsm::RowInfo& row : machine_.rows) {
      const int span = position[row.target] - position[row.source];
      if (span > 1) sum += span;
      if (span < 0) sum += 1 - span;
    }
    return sum;
  }

  /// Tries every order that begins with the initial state; machines have few states.
  void order_states() {
    std::vector<std::size_t> order(machine_.states.size());
    std::iota(order.begin(), order.end(), 0);
    std::swap(order[0], order[machine_.initial]);
    std::sort(order.begin() + 1, order.end());
    constexpr std::size_t most_states = 8;
    order_ = order;
    if (order.size() > most_states) return;
    int least = cost(order);
    while (std::next_permutation(order.begin() + 1, order.end())) {
      const int now = cost(order);
      if (now >= least) continue;
      least = now;
      order_ = order;
    }
  }

  void place_in_column() {
    position_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      position_[order_[k]] = k;
      MachineLayout::State state;
      state.name = machine_.states[order_[k]];
      state.words = fsm::words_of_state(state.name);
      for (const fsm::RowInfo& row : machine_.rows) {
        if (row.source != order_[k] || row.target != order_[k]) continue;
        const auto lines = report::wrapped("↻ " + row_text(machine_, row), own_row_columns, 4);
        state.own_rows.insert(state.own_rows.end(), lines.begin(), lines.end());
      }
      layout_.box_width =
          std::max({layout_.box_width, 120, width_of(state.name) + 4 * padding,
                    width_of(state.words) + 2 * padding, widest(state.own_rows) + 2 * padding});
      layout_.states.push_back(std::move(state));
    }
  }

  void collect_edges() {
    using Ends = std::pair<std::size_t, std::size_t>;
    std::map<Ends, std::vector<std::string>> labels;
    for (const fsm::RowInfo& row : machine_.rows) {
      if (row.source == row.target) continue;
      auto& label = labels[{position_[row.source], position_[row.target]}];
      const auto lines = report::wrapped(row_text(machine_, row), label_columns, 2);
      label.insert(label.end(), lines.begin(), lines.end());
    }
    for (const auto& entry : labels) {
      const auto& ends = entry.first;  // a lambda of clang 14 captures no structured binding
      const auto& label = entry.second;
      const Side side = ends.second > ends.first ? Side::right : Side::left;
      const auto twin = std::ranges::find_if(layout_.edges, [&](const Edge& edge) {
        return edge.side == side && edge.target.state == ends.second && edge.label == label;
      });
      if (twin != layout_.edges.end()) {
        twin->sources.push_back({ends.first, 0});
        continue;
      }
      Edge edge;
      edge.side = side;
      edge.sources.push_back({ends.first, 0});
      edge.target.state = ends.second;
      edge.label = label;
      layout_.edges.push_back(std::move(edge));
    }
    for (Edge& edge : layout_.edges) {
      const bool next = edge.sources.size() == 1 && edge.target.state == edge.sources[0].state + 1;
      if (next) edge.side = Side::straight;
    }
  }

  static std::size_t top_of(const Edge& edge) {
    std::size_t top = edge.target.state;
    for (const MachineLayout::Port& port : edge.sources) top = std::min(top, port.state);
    return top;
  }
  static std::size_t bottom_of(const Edge& edge) {
    std::size_t bottom = edge.target.state;
    for (const MachineLayout::Port& port : edge.sources) bottom = std::max(bottom, port.state);
    return bottom;
  }

  /// The middle gap along the edge.
  void choose_gap(Edge& edge) { edge.gap = (top_of(edge) + bottom_of(edge) - 1) / 2; }

  /// Tracks with a short way run inside, and their ports are nearest to where they lead.
  [[nodiscard]] std::vector<Edge*> tracks(Side side) {
    std::vector<Edge*> found;
    for (Edge& edge : layout_.edges) {
      if (edge.side == side) found.push_back(&edge);
    }
    std::ranges::stable_sort(found, {},
                             [](const Edge* edge) { return bottom_of(*edge) - top_of(*edge); });
    return found;
  }

  /// The ports of a state on one side, from top to bottom: what leads up, then what leads down;
  /// inner tracks outermost, so that edges cross as little as possible.
  void count_ports() {
    for (const Side side : {Side::left, Side::right}) {
      for (std::size_t s = 0; s < layout_.states.size(); ++s) {
        std::vector<MachineLayout::Port*> up;
        std::vector<MachineLayout::Port*> down;
        for (Edge* edge : tracks(side)) {
          const auto add = [&](MachineLayout::Port& port) {
            if (port.state != s) return;
            (bottom_of(*edge) == s || (top_of(*edge) != s && &port != &edge->target) ? up : down)
                .push_back(&port);
          };
          add(edge->target);
          for (MachineLayout::Port& port : edge->sources) add(port);
        }
        std::vector<MachineLayout::Port*> all = up;
        all.insert(all.end(), down.rbegin(), down.rend());
        ports_.push_back(std::move(all));
      }
    }
  }
  [[nodiscard]] std::vector<MachineLayout::Port*>& ports(Side side, std::size_t state) {
    return ports_[(side == Side::left ? 0 : layout_.states.size()) + state];
  }

  void place_states() {
    std::vector<int> gaps(layout_.states.size(), least_gap);
    for (const Edge& edge : layout_.edges) {
      gaps[edge.gap] = std::max(gaps[edge.gap], height_of(edge.label) + 24);
    }
    int y = head_room;
    for (std::size_t s = 0; s < layout_.states.size(); ++s) {
      MachineLayout::State& state = layout_.states[s];
      const auto most = std::max(ports(Side::left, s).size(), ports(Side::right, s).size());
      const int rows = state.own_rows.empty() ? 0 : height_of(state.own_rows) + padding;
      state.y = y;
      const int words = state.words.empty() ? 0 : MachineLayout::line_height;
      state.height = std::max(36 + words + rows, port_distance * static_cast<int>(most + 1));
      y += state.height + gaps[s];
      if (s + 1 == layout_.states.size()) layout_.height = state.y + state.height;
    }
    for (Edge& edge : layout_.edges) {
      const MachineLayout::State& above = layout_.states[edge.gap];
      const int middle = above.y + above.height + gaps[edge.gap] / 2;
      edge.label_y = middle - height_of(edge.label) / 2 + 12;
    }
    layout_.height += MachineLayout::margin;
  }

  void place_ports() {
    for (const Side side : {Side::left, Side::right}) {
      for (std::size_t s = 0; s < layout_.states.size(); ++s) {
        auto& list = ports(side, s);
        const MachineLayout::State& state = layout_.states[s];
        for (std::size_t k = 0; k < list.size(); ++k) {
          list[k]->y =
              state.y + state.height * static_cast<int>(k + 1) / static_cast<int>(list.size() + 1);
        }
      }
    }
  }

  /// Tracks side by side, nearest to the states first. Those that do not meet share a place.
  [[nodiscard]] std::vector<std::vector<Edge*>> places(Side side) {
    const auto ends = [](const Edge& edge) {
      std::pair<int, int> range{edge.target.y, edge.target.y};
      for (const MachineLayout::Port& port : edge.sources) {
        range = {std::min(range.first, port.y), std::max(range.second, port.y)};
      }
      return range;
    };
    const auto meet = [&](const Edge* a, const Edge* b) {
      const auto [a_top, a_bottom] = ends(*a);
      const auto [b_top, b_bottom] = ends(*b);
      return a_top <= b_bottom + 8 && b_top <= a_bottom + 8;
    };
    std::vector<std::vector<Edge*>> found;
    for (Edge* edge : tracks(side)) {
      const auto free = std::ranges::find_if(found, [&](const auto& place) {
        return std::ranges::none_of(place, [&](const Edge* other) { return meet(edge, other); });
      });
      if (free == found.end())
        found.push_back({edge});
      else
        free->push_back(edge);
    }
    return found;
  }

  static int label_width(const std::vector<Edge*>& place) {
    int width = 0;
    for (const Edge* edge : place) width = std::max(width, widest(edge->label));
    return width;
  }

  void place_tracks() {
    const auto left = places(Side::left);
    layout_.left = MachineLayout::margin;
    for (const auto& place : left) layout_.left += 3 * padding + label_width(place);
    int straight = 0;
    for (const Edge& edge : layout_.edges) {
      if (edge.side == Side::straight) straight = std::max(straight, widest(edge.label));
    }
    const int right_of_boxes = layout_.left + layout_.box_width;
    // A label of a straight edge begins in the middle of the states and may be longer than they.
    const int middle = layout_.left + layout_.box_width / 2;
    int x = std::max(right_of_boxes, middle + padding + straight);
    for (const auto& place : places(Side::right)) {
      for (Edge* edge : place) edge->x = x + 2 * padding;
      x += 3 * padding + label_width(place);
    }
    layout_.width = std::max(x + MachineLayout::margin, 320);
    x = layout_.left;
    for (const auto& place : left) {
      for (Edge* edge : place) edge->x = x - 2 * padding;
      x -= 3 * padding + label_width(place);
    }
    for (Edge& edge : layout_.edges) {
      if (edge.side == Side::straight) edge.x = middle;
    }
  }

  const fsm::MachineInfo& machine_;
  MachineLayout layout_;
  std::vector<std::size_t> order_;     // position → state
  std::vector<std::size_t> position_;  // state → position
  std::vector<std::vector<MachineLayout::Port*>> ports_;
};

}  // namespace

MachineLayout layout_of(const fsm::MachineInfo& machine) { return Planner{machine}.run(); }

}  // namespace stormproof::draw

// Names and sums.
#include "checker/evidence/validate/figures.hpp"

namespace stormproof::validate {

namespace {

using model::MessageClass;

struct Words {
  const char* name;
  const char* label;
};
constexpr Words words_of_class(MessageClass one) { return {name_of(one), words_of(one)}; }
constexpr std::array<Words, figure_count> words{{{"t_disc_ns", "completion"},
                                                 {"total", "messages"},
                                                 words_of_class(MessageClass::initial_data),
                                                 words_of_class(MessageClass::repair_data),
                                                 words_of_class(MessageClass::heartbeat),
                                                 words_of_class(MessageClass::acknack),
                                                 words_of_class(MessageClass::spdp_multicast),
                                                 words_of_class(MessageClass::spdp_unicast),
                                                 {"initial_pulled", "pulled"},
                                                 {"heartbeat_open", "relation opens"},
                                                 {"heartbeat_reply", "reply"},
                                                 {"heartbeat_piggyback", "piggyback"},
                                                 {"heartbeat_periodic", "periodic"},
                                                 {"acknack_initial", "initial"},
                                                 {"acknack_negative", "negative"},
                                                 {"acknack_positive", "positive"},
                                                 {"datagrams", "datagrams"},
                                                 {"payload_bytes", "UDP payload bytes"},
                                                 {"last_open_ns", "last relation"},
                                                 {"last_initial_ns", "last initial DATA"},
                                                 {"user_control", "user control"},
                                                 {"pdp_data", "DATA(p)"},
                                                 {"pdp_heartbeat", "HEARTBEAT(p)"},
                                                 {"pdp_acknack", "ACKNACK(p)"},
                                                 {"gap", "GAP"}}};

}  // namespace

const char* name_of(Figure figure) { return words[index_of(figure)].name; }
const char* label_of(Figure figure) { return words[index_of(figure)].label; }

void add(Tally& tally, model::MessageClass one, std::uint64_t messages) {
  tally[index_of(figure_of(one))] += messages;
  tally[index_of(Figure::total)] += messages;
}

void add_of_server(Tally& tally, Figure one) {
  ++tally[index_of(one)];
  ++tally[index_of(Figure::total)];
}

GrowthPoint growth_point(const Tally& tally) {
  GrowthPoint point{};
  for (std::size_t curve = 0; curve < growth_curves; ++curve) {
    point[curve] = tally[index_of(figure_of_curve(curve))];
  }
  return point;
}

}  // namespace stormproof::validate

// The tables of the vectors of the Wi-Fi channel. Whole runs have the deployments of Fast DDS's
// vectors.
#include "tests/vectors/wifi_vectors.hpp"

#include <algorithm>
#include <stdexcept>

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::WirelessProfile;
using Packets = std::vector<ChannelPacket>;
using Arrivals = std::vector<std::int64_t>;

constexpr std::nullopt_t all = std::nullopt;

template <class Change>
WirelessProfile with(WirelessProfile wireless, Change change) {
  change(wireless);
  return wireless;
}

void flows(WirelessProfile& w) { w.queueing = model::Queueing::flows; }
void short_units(WirelessProfile& w) { w.aggregation.max_frames = 2; }
void oldest_request(WirelessProfile& w) { w.arbitration = model::Arbitration::oldest; }
void queues_in_turns(WirelessProfile& w) { w.ap_queue = model::ApQueue::round_robin; }

std::vector<ChannelVector> fifo_vectors() {
  const WirelessProfile usual = units_of_80211n();
  return {
      {"one", usual, 2, {{0, 0, 1, 68}}, {403848}},
      {"three_in_a_unit",
       usual,
       2,
       {{0, 0, 1, 68}, {0, 0, 1, 420}, {0, 0, 1, 68}},
       {482540, 482540, 482540}},
      {"both_ways",
       usual,
       2,
       {{0, 0, 1, 68}, {0, 1, 0, 420}, {0, 0, all, 252}, {0, 1, 0, 68}},
       {659644, 1447658, 1214144, 1447658}},
      {"turns",
       usual,
       2,
       {{0, 0, 1, 68},
        {100000, 0, 1, 68},
        {100000, 1, 0, 68},
        {250000, 0, 1, 1472},
        {250000, 0, 1, 1473}},
       {605772, 1569460, 1188578, 1569460, 1569460}},
      {"many_fragments",
       usual,
       2,
       {{0, 0, 1, 65000}, {0, 1, 0, 68}, {0, 0, 1, 68}},
       {8728486, 8357354, 8728486}},
      {"max_frames",
       with(usual, short_units),
       2,
       {{0, 0, 1, 68}, {0, 0, 1, 68}, {0, 0, 1, 68}, {0, 1, 0, 68}, {0, 1, 0, 68}},
       {642036, 642036, 1259896, 1057972, 1057972}},
      {"oldest",
       with(usual, oldest_request),
       2,
       {{0, 0, 1, 68}, {0, 1, 0, 68}, {10000, 0, 1, 68}, {20000, 1, 0, 420}, {20000, 0, all, 252}},
       {873656, 1107170, 873656, 1107170, 1661670}},
      {"queues_in_turns",
       with(usual, queues_in_turns),
       2,
       {{0, 0, all, 252}, {0, 0, all, 252}, {0, 0, 1, 68}, {0, 1, 0, 68}},
       {998581, 1956929, 1402429, 1200505}}};
}

std::vector<ChannelVector> limit_vectors() {
  const WirelessProfile usual = units_of_80211n();
  const auto four_frames = [](WirelessProfile& w) {
    flows(w);
    w.aggregation.max_frames = 4;
  };
  const auto short_flows = [](WirelessProfile& w) {
    flows(w);
    w.aggregation.max_airtime = Nanoseconds{20'000};
  };
  const auto few_bytes = [](WirelessProfile& w) { w.aggregation.max_bytes = Bytes{280}; };
  const auto short_airtime = [](WirelessProfile& w) {
    w.aggregation.max_airtime = Nanoseconds{1'000'000};
  };
  return {{"flows",
           with(usual, four_frames),
           2,
           {{0, 0, 1, 10000},
            {0, 0, 1, 68, 1},
            {0, 0, 1, 68, 1},
            {0, 0, 1, 68, 2},
            {300000, 0, 1, 68, 3}},
           {2411610, 614618, 614618, 614618, 1540372}},
          {"flows_put_back",
           with(usual, short_flows),
           2,
           {{0, 0, 1, 420, 1},
            {0, 0, 1, 68, 1},
            {10000, 0, 1, 252, 2},
            {300000, 0, 1, 420, 1},
            {300000, 0, 1, 1000, 2},
            {300000, 0, 1, 68, 2}},
           {442850, 846698, 1270934, 2220900, 1778050, 2624748}},
          {"max_bytes",
           with(usual, few_bytes),
           2,
           {{0, 0, 1, 68}, {0, 0, 1, 68}, {0, 0, 1, 71}, {0, 0, 1, 68}},
           {428024, 428024, 832204, 1236052}},
          {"max_airtime",
           with(usual, short_airtime),
           2,
           {{0, 0, 1, 20000}, {0, 0, 1, 20000}},
           {4649956, 5823466}},
          {"three_hosts",
           usual,
           3,
           {{0, 0, 1, 68}, {0, 0, 2, 68}, {0, 0, 1, 68}, {0, 1, 2, 420}, {0, 2, all, 252}},
           {869324, 1102838, 869324, 1102838, 1657338}}};
}

/// One frame for each access, with the overheads of 802.11n.
WirelessProfile frames_of_80211n() {
  WirelessProfile w;
  w.order = model::ServiceOrder::fifo;
  w.fragment_request = model::FragmentRequest::at_admission;
  w.sender = model::Sender::stalls;
  return w;
}

model::Scenario over(const std::string& deployment, const WirelessProfile& wireless) {
  const std::vector<Vector>& known = fastdds_vectors();
  const auto found = std::ranges::find(known, deployment, &Vector::name);
  if (found == known.end()) throw std::logic_error{"no vector " + deployment};
  model::Scenario scenario = found->scenario;
  scenario.wireless = wireless;
  return scenario;
}

}  // namespace

WirelessProfile units_of_80211n() {
  WirelessProfile w;
  w.service = model::ServedBy::unit;
  w.fragment_request = model::FragmentRequest::at_admission;
  return w;
}

const std::vector<ChannelVector>& channel_vectors() {
  static const std::vector<ChannelVector> table = [] {
    std::vector<ChannelVector> both = fifo_vectors();
    std::ranges::copy(limit_vectors(), std::back_inserter(both));
    return both;
  }();
  return table;
}

const std::vector<Vector>& wifi_vectors() {
  static const std::vector<Vector> table = [] {
    const WirelessProfile units =
        with(units_of_80211n(), [](WirelessProfile& w) { w.sender = model::Sender::stalls; });
    const WirelessProfile of_flows = with(units, flows);
    const WirelessProfile frames = frames_of_80211n();
    const auto small_queue = [](WirelessProfile& w) { w.source_queue_bytes = Bytes{4'000}; };
    const auto small_flows = [&](WirelessProfile& w) {
      small_queue(w);
      w.aggregation.max_bytes = Bytes{4'000};
    };
    const auto admitted = [](WirelessProfile& w) { w.count_at = model::CountAt::admission; };
    const std::string three = "hosts2x3x20";
    const std::string five = "hosts2x5x20";
    const std::string six = "hosts2x6x30";
    return std::vector<Vector>{
        {"units_3x20", over(three, units), {92408386, 666, 0, 42, 42, 36, 46}, 287},
        {"units_5x20", over(five, units), {274057643, 1850, 394, 707, 291, 120, 288}, 1049},
        {"flows_5x20", over(five, of_flows), {466429339, 1850, 1887, 6234, 1441, 140, 370}, 1661},
        {"flows_6x30", over(six, of_flows), {1287485804, 3384, 6062, 32013, 5620, 204, 614}, 4362},
        {"frames_5x20", over(five, frames), {1979403330, 1850, 644, 2696, 1372, 150, 414}, 2546},
        {"frames_6x30", over(six, frames), {4206772078, 3384, 2008, 12050, 1975, 211, 664}, 5901},
        {"frames_6x30_admitted",
         over(six, with(frames, admitted)),
         {4206772078, 3384, 1998, 11991, 1975, 211, 664},
         5879},
        {"flows_small_queue",
         over(three, with(of_flows, small_flows)),
         {151513279, 666, 80, 99, 74, 42, 63},
         403},
        {"frames_small_queue",
         over(three, with(frames, small_queue)),
         {574201130, 666, 0, 42, 42, 54, 97},
         582}};
  }();
  return table;
}

}  // namespace stormproof::vectors

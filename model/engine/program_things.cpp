// The list of all knobs, by their names in programs.
#include "model/engine/program_things.hpp"

#include <map>
#include <string_view>

#include "fsm/composition/amended.hpp"
#include "fsm/composition/cyclone_life.hpp"
#include "fsm/composition/fastdds_life.hpp"
#include "fsm/composition/server_life.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/timer_kinds.hpp"

namespace stormproof::model {
namespace {

using fsm::TypeList;
using fsm::program::Thing;

/// Whoever adds a knob that is missing here is told by the first program that is asked for it.
using Knobs = TypeList<
    comp::AcceptsUnmatched, comp::ConstantInterval, comp::Additive, comp::Adaptive,
    comp::ResendsToAll, comp::ResendsCopyAndMulticast, comp::ResendsCopy,
    comp::paper::PushesInitialData, comp::paper::PrefixOnly, comp::paper::InitialCountsAsAckNack,
    comp::paper::InitialIsAnsweredByHeartbeat, comp::paper::HeartbeatToMatched,
    comp::paper::ReceiverOpensBothSides, comp::InitialDelay, comp::ResponseDelay,
    comp::HeartbeatPeriod, comp::MinPeriod, comp::MaxPeriod, comp::EpsilonNumerator,
    comp::EpsilonDenominator, comp::StartupAnnouncements, comp::StartupPeriod,
    comp::AnnouncementPeriod, comp::paper::NackResponseDelay, comp::paper::SuppressionDuration,
    comp::fastdds::NackResponseDelay, comp::fastdds::SuppressionDuration, comp::Immediately,
    comp::lookup::LooksUpTypes, comp::lookup::FiltersAnswers, comp::lookup::FiltersQuestions,
    comp::lookup::AsksForStreams, comp::lookup::AsksForAll, comp::fastdds::OpensBuiltinFirst,
    comp::control::TopicReplyDelay, comp::control::BuiltinReplyDelay, comp::lookup::ExpiryPeriod,
    comp::cyclone::MergesQueued, comp::cyclone::TellsFreshAtOnce, comp::cyclone::HeartbeatInterval,
    comp::cyclone::HeartbeatIntervalMax, comp::cyclone::MatchHeartbeatDelay,
    comp::cyclone::AckDelay, comp::cyclone::NackDelay, comp::cyclone::AutoReschedNackDelay,
    comp::cyclone::PreEmptiveAckDelay, comp::cyclone::PreEmptiveRepeatDelay,
    comp::cyclone::CountWindow, comp::cyclone::SpdpStartupPeriod, comp::cyclone::SpdpPeriod,
    comp::cyclone::DirectedReplies, comp::cyclone::DirectedReplyInterval,
    comp::cyclone::PiggybackDelay, comp::server::ClientSyncPeriod, comp::server::RoutinePeriod,
    comp::server::RegistrationHeartbeatPeriod, comp::server::RegistrationResponseDelay,
    comp::server::KnownByLocator, comp::amended::InitialResets, comp::amended::InitialArms,
    comp::amended::IgnoresLateInitial, comp::amended::AsksOnce,
    comp::amended::AsksAtOnceBeforeCreation, comp::amended::AsksByAge, comp::amended::AgePeriod,
    comp::amended::StopsWhenComplete, comp::amended::ReopensAcknowledged,
    comp::amended::ResendsAcknowledged, comp::amended::OnlyInUWaits, comp::amended::MeasuresAcks,
    comp::amended::ShortestMeasured, comp::amended::LongestMeasured,
    comp::amended::SuppressionEndArms, comp::amended::HeartbeatBeforeRepair,
    comp::amended::HeartbeatAfterRepair, comp::amended::AnswersRequests,
    comp::amended::AnswersEachAckNack, comp::amended::LatestOnly, comp::amended::RequiredDrops,
    comp::amended::RequiredGates, comp::amended::RequiredAtRepair, comp::amended::AcksHighest,
    comp::amended::AcksMissing, comp::amended::RetriesAfterNack,
    comp::amended::RetriesWheneverMissing, comp::amended::MatchClockSkew,
    comp::amended::RetryPeriod, comp::amended::NackDelay, comp::amended::ResendCopies,
    comp::amended::ResendCopyPeriod, comp::amended::CountFilter>;

using Value = std::int64_t (*)(const DdsProfile&);

std::map<std::string_view, Value> values() {
  std::map<std::string_view, Value> all;
  comp::for_each_type(Knobs{}, [&]<class Knob>() {
    all.emplace(fsm::full_name_of<Knob>(), [](const DdsProfile& dds) {
      return static_cast<std::int64_t>(knob_value(Knob{}, dds));
    });
  });
  return all;
}

std::map<std::string_view, EventKind> event_kinds() {
  std::map<std::string_view, EventKind> all;
  const auto add = [&]<class Timer>() {
    all.emplace(fsm::full_name_of<Timer>(), event_kind_of<Timer>);
  };
  comp::for_each_type(comp::paper::Paper::Timers{}, add);
  comp::for_each_type(comp::fastdds::FastDds::Timers{}, add);
  comp::for_each_type(comp::cyclone::Cyclone::Timers{}, add);
  comp::for_each_type(comp::server::FastDdsServer::Timers{}, add);
  comp::for_each_type(comp::amended::Amended::Timers{}, add);
  comp::for_each_type(comp::fastdds::FastDdsLiving::Timers{}, add);
  comp::for_each_type(comp::cyclone::CycloneLiving::Timers{}, add);
  comp::for_each_type(comp::server::FastDdsServerLiving::Timers{}, add);
  return all;
}

}  // namespace

std::optional<std::int64_t> knob_value(const Thing& knob, const DdsProfile& dds) {
  static const std::map<std::string_view, Value> all = values();
  const auto found = all.find(knob.full_name);
  if (found != all.end()) return found->second(dds);
  return std::nullopt;
}

EventKind event_kind(const Thing& timer) {
  static const std::map<std::string_view, EventKind> all = event_kinds();
  const auto found = all.find(timer.full_name);
  return found == all.end() ? EventKind::dispatch : found->second;
}

}  // namespace stormproof::model

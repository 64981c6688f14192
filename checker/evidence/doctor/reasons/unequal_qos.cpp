// Endpoints of one topic that discover each other and do not match: what the writer offers is not
// what the reader requests, or their types differ.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

struct Place {
  std::size_t participant = 0;
  const capture::Endpoint* endpoint = nullptr;
};
struct Topic {
  std::vector<Place> writers{};
  std::vector<Place> readers{};
};
/// What differs, and in how many pairs of endpoints.
struct Difference {
  std::uint64_t pairs = 0;
  Place writer, reader;  ///< of the first
};

std::map<std::string, Topic> topics_of(const Contacts& contacts) {
  std::map<std::string, Topic> topics;
  const auto& list = contacts.topology().participants;
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (const auto& [guid, endpoint] : list[k].endpoints) {
      if (endpoint.is_gone || endpoint.topic.empty()) continue;
      const bool writes = endpoint.announced_by == capture::entity::publications_writer;
      Topic& topic = topics[endpoint.topic];
      (writes ? topic.writers : topic.readers).push_back({k, &endpoint});
    }
  }
  return topics;
}

/// A topic with thousands of endpoints is compared by those of the first pairs only.
constexpr std::size_t most_compared = 256;

std::map<std::string, Difference> differences_in(const Topic& topic, const Contacts& contacts) {
  std::map<std::string, Difference> found;
  const auto& list = contacts.topology().participants;
  const std::size_t writers = std::min(topic.writers.size(), most_compared);
  const std::size_t readers = std::min(topic.readers.size(), most_compared);
  for (std::size_t w = 0; w < writers; ++w) {
    for (std::size_t r = 0; r < readers; ++r) {
      const Place& writer = topic.writers[w];
      const Place& reader = topic.readers[r];
      if (list[writer.participant].domain != list[reader.participant].domain) continue;
      auto texts = capture::disagreements(writer.endpoint->qos, reader.endpoint->qos);
      const std::string& offered = writer.endpoint->type;
      const std::string& requested = reader.endpoint->type;
      if (offered != requested && !offered.empty() && !requested.empty()) {
        texts.push_back(fmt::format("type: offered {}, requested {}", offered, requested));
      }
      for (std::string& text : texts) {
        const auto [one, is_new] =
            found.try_emplace(std::move(text), Difference{0, writer, reader});
        ++one->second.pairs;
      }
    }
  }
  return found;
}

}  // namespace

void unequal_qos(const Contacts& contacts, std::vector<Reason>& found) {
  constexpr std::size_t most_told = 8;
  std::size_t told = 0;
  for (const auto& [name, topic] : topics_of(contacts)) {
    for (const auto& [text, difference] : differences_in(topic, contacts)) {
      if (++told > most_told) return;
      Reason reason;
      reason.id = text.starts_with("type:") ? "unequal_types" : "unequal_qos";
      reason.sentence = fmt::format(
          "topic {}: {}; so {} of endpoints do not match, such as the writer of {} and the reader "
          "of "
          "{}",
          name, text, report::plural(difference.pairs, "pair"),
          contacts.text(difference.writer.participant),
          contacts.text(difference.reader.participant));
      reason.remedy = reason.id == "unequal_types"
                          ? "the same message type on both sides"
                          : "give the writer what the reader requests, or let the reader request "
                            "less (ros2 topic info -v shows both)";
      reason.keeps_apart = false;
      found.push_back(std::move(reason));
    }
  }
}

}  // namespace stormproof::doctor

// The paper's DDS implementation: announcements, the reader side and the writer side of every
// relation, by the rules of specs/guide/model.md. The class is spread over four source files by
// rule group:
//   announcements.cpp  SPDP: sending, reception, opening of relations
//   reader.cpp         reception of DATA and HEARTBEAT, ACKNACKs
//   writer.cpp         reception of ACKNACKs, repair, suppression
//   data.cpp           generation of DATA and HEARTBEATs, grouping, piggyback
// What Fast DDS does alike is in model/engine/discovery_base.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "model/descriptor_sizes.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/paper/descriptor_states.hpp"

namespace stormproof::model::paper {

/// A rank that no recipient has: the relation is not open, the participant is not known.
inline constexpr std::uint32_t no_rank = UINT32_MAX;

class Protocol final : public DiscoveryBase {
 public:
  static constexpr SameHostPairs same_host_pairs =
      SameHostPairs::left_out;  ///< same-host traffic never touches the channel

  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet& packet) override;
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;
  [[nodiscard]] std::uint32_t next_recipient(const Packet& packet,
                                             std::uint32_t pair) const override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

 private:
  struct Relation : ReaderSide {
    std::uint32_t unacknowledged = 0;  ///< descriptors not in A
    std::uint32_t open_rank =
        no_rank;  ///< writer side: how many relations of the writer opened before
  };

  struct Writer {
    std::int64_t budget = 0;           ///< piggyback budget, bytes
    std::uint32_t open = 0;            ///< open relations
    std::uint32_t unacknowledged = 0;  ///< open relations with a descriptor not in A
    std::uint32_t first_open_pair = UINT32_MAX;
    std::vector<std::uint64_t> waiting_readers;  ///< bit per peer: open and something not in A
  };

  struct Participant {
    std::uint32_t known = 0;  ///< cross-host participants it has recognised
    std::uint32_t first_known_pair = UINT32_MAX;
    std::int64_t sent_bytes = 0;  ///< the cumulative charge of the piggyback rule
  };

  // announcements.cpp
  void send_spdp_to_known(std::uint32_t i) override;
  void send_spdp_multicast(std::uint32_t i) override;
  void send_spdp_copy(std::uint32_t pair) override;
  void spdp_received(std::uint32_t pair);
  void open_writer(std::uint32_t relation);

  // reader.cpp
  void data_received(const Packet& packet);
  void heartbeat_received(std::uint32_t relation);
  void emit_acknack(std::uint32_t relation, bool initial) override;
  [[nodiscard]] bool has_started(std::uint32_t participant) const;

  // writer.cpp
  void acknack_received(const Packet& packet);
  void repair_generation(std::uint32_t relation);
  void suppression_end(std::uint32_t relation);

  // data.cpp
  void generate_data(std::uint32_t relation, const DescriptorSet& descriptors, bool repair);
  void send_heartbeat_to_open(std::uint32_t writer);
  struct Message;
  void flush(Message& message);
  void charge(Message& message, std::int64_t added_bytes);

  // HeartbeatSender, in protocol.cpp and data.cpp
  [[nodiscard]] bool needs_heartbeat(std::uint32_t writer) const override;
  [[nodiscard]] std::vector<std::uint32_t> unacknowledged(std::uint32_t writer) const override;
  [[nodiscard]] bool is_unacknowledged(std::uint32_t relation) const override;
  [[nodiscard]] std::uint32_t announced(std::uint32_t writer) const override;
  void send_periodic(std::uint32_t writer) override;
  void send_heartbeat(std::uint32_t relation) override;

  [[nodiscard]] ReaderSide& reader_side(std::uint32_t relation) override {
    return relations_[relation];
  }

  DescriptorStates descriptors_;
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;  // 2 · participant + stream
  std::vector<Relation> relations_;
  std::vector<std::uint32_t> known_rank_;  // by pair (i, j): when i recognised j
  const DescriptorSizes sizes_;
};

}  // namespace stormproof::model::paper

// Finds packets, messages and submessages by the layouts of pcap and RTPS 2.x, section 9.4.5, and
// overwrites single fields.
#include "tests/fuzzing/capture_mutator.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <random>

namespace stormproof::fuzzing {

namespace {

constexpr std::size_t file_header = 24;
constexpr std::size_t record_header = 16;
constexpr std::size_t message_header = 20;
constexpr std::size_t submessage_header = 4;

std::uint32_t read_32(const CaptureBytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{bytes[at + k]} << (8 * k);
  return value;
}

void write_32(CaptureBytes& bytes, std::size_t at, std::uint32_t value, bool little = true) {
  for (std::size_t k = 0; k < 4; ++k) {
    bytes[at + k] = static_cast<std::uint8_t>(value >> (8 * (little ? k : 3 - k)));
  }
}

/// Where something stands.
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The packets of a little-endian pcap file, with their headers.
std::vector<Range> records_of(const CaptureBytes& file) {
  std::vector<Range> records;
  if (file.size() < file_header || read_32(file, 0) != 0xa1b2c3d4U) return records;
  for (std::size_t at = file_header; at + record_header <= file.size();) {
    const std::size_t end = at + record_header + read_32(file, at + 8);
    if (end > file.size()) break;
    records.push_back({at, end});
    at = end;
  }
  return records;
}

/// A field that a mistake can be made in.
struct Field {
  enum class Kind : std::uint8_t { sequence_number, bit_count, entity, length };
  Kind kind{};
  std::size_t at = 0;
  bool little = true;
};

void add_fields(const CaptureBytes& file, Range submessage, std::vector<Field>& fields) {
  const std::uint8_t id = file[submessage.begin];
  const bool little = (file[submessage.begin + 1] & 1U) != 0;
  const std::size_t body = submessage.begin + submessage_header;
  const auto add = [&](Field::Kind kind, std::size_t offset, std::size_t size) {
    if (body + offset + size <= submessage.end) fields.push_back({kind, body + offset, little});
  };
  using enum Field::Kind;
  fields.push_back({length, submessage.begin + 2, little});
  constexpr std::uint8_t acknack = 0x06, heartbeat = 0x07, data = 0x15;
  if (id == data) {
    add(entity, 8, 4);
    add(sequence_number, 12, 8);
  } else if (id == heartbeat) {
    add(entity, 4, 4);
    add(sequence_number, 8, 8);
    add(sequence_number, 16, 8);
  } else if (id == acknack) {
    add(entity, 4, 4);
    add(sequence_number, 8, 8);
    add(bit_count, 16, 4);
  }
}

std::vector<Field> fields_of(const CaptureBytes& file, const std::vector<Range>& records) {
  constexpr std::array<std::uint8_t, 4> magic{'R', 'T', 'P', 'S'};
  std::vector<Field> fields;
  for (const Range& record : records) {
    const auto end = file.begin() + static_cast<std::ptrdiff_t>(record.end);
    const auto found = std::search(file.begin() + static_cast<std::ptrdiff_t>(record.begin), end,
                                   magic.begin(), magic.end());
    std::size_t at = static_cast<std::size_t>(found - file.begin()) + message_header;
    while (at + submessage_header <= record.end) {
      const bool little = (file[at + 1] & 1U) != 0;
      const std::size_t size = little ? file[at + 2] | std::size_t{file[at + 3]} << 8U
                                      : file[at + 3] | std::size_t{file[at + 2]} << 8U;
      const Range submessage{at, std::min(record.end, at + submessage_header + size)};
      add_fields(file, submessage, fields);
      if (size == 0) break;
      at = submessage.end;
    }
  }
  return fields;
}

class Mutator {
 public:
  Mutator(CaptureBytes file, std::uint64_t seed) : file_{std::move(file)}, random_{seed} {}

  CaptureBytes run() && {
    const std::size_t mistakes = 1 + below(3);
    for (std::size_t k = 0; k < mistakes; ++k) {
      const std::vector<Range> records = records_of(file_);
      const std::vector<Field> fields = fields_of(file_, records);
      if (fields.empty()) break;
      below(4) == 0 ? change_packet(records) : change_field(fields[below(fields.size())]);
    }
    return std::move(file_);
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  template <class T, std::size_t size>
  T one_of(const std::array<T, size>& values) {
    return values[below(size)];
  }

  void change_field(const Field& field) {
    constexpr std::array<std::int64_t, 12> numbers{-1,
                                                   0,
                                                   1,
                                                   2,
                                                   255,
                                                   256,
                                                   257,
                                                   65'536,
                                                   std::int64_t{1} << 31U,
                                                   std::int64_t{1} << 40U,
                                                   std::numeric_limits<std::int64_t>::max(),
                                                   std::numeric_limits<std::int64_t>::min()};
    constexpr std::array<std::uint32_t, 8> bits{0, 1, 31, 33, 256, 257, 65'536, 0x80000000U};
    constexpr std::array<std::uint32_t, 6> entities{0x000100c2U, 0x000003c2U, 0x000004c2U,
                                                    0x000200c2U, 0x00000000U, 0xffffffffU};
    constexpr std::array<std::uint32_t, 6> lengths{0, 4, 20, 24, 0x7ffcU, 0xffffU};
    switch (field.kind) {
      case Field::Kind::sequence_number: {
        const auto number = static_cast<std::uint64_t>(one_of(numbers));
        write_32(file_, field.at, static_cast<std::uint32_t>(number >> 32U), field.little);
        write_32(file_, field.at + 4, static_cast<std::uint32_t>(number), field.little);
        break;
      }
      case Field::Kind::bit_count:
        write_32(file_, field.at, one_of(bits), field.little);
        break;
      case Field::Kind::entity:
        write_32(file_, field.at, one_of(entities), false);
        break;
      case Field::Kind::length: {
        const std::uint32_t length = one_of(lengths);
        const auto low = static_cast<std::uint8_t>(length);
        const auto high = static_cast<std::uint8_t>(length >> 8U);
        file_[field.at] = field.little ? low : high;
        file_[field.at + 1] = field.little ? high : low;
        break;
      }
    }
  }

  /// Missing, twice, before the one before it, or at another time.
  void change_packet(const std::vector<Range>& records) {
    const std::size_t chosen = below(records.size());
    const auto [begin, end] = records[chosen];
    const auto position = [&](std::size_t at) {
      return file_.begin() + static_cast<std::ptrdiff_t>(at);
    };
    switch (below(4)) {
      case 0:
        file_.erase(position(begin), position(end));
        break;
      case 1: {
        const CaptureBytes copy{position(begin), position(end)};
        file_.insert(position(end), copy.begin(), copy.end());
        break;
      }
      case 2:
        if (chosen > 0) {
          std::rotate(position(records[chosen - 1].begin), position(begin), position(end));
        }
        break;
      default:
        write_32(file_, begin,
                 one_of(std::array<std::uint32_t, 4>{0, 1, 0x7fffffffU, 0xffffffffU}));
    }
  }

  CaptureBytes file_;
  std::mt19937_64 random_;
};

}  // namespace

CaptureBytes with_mistakes(const CaptureBytes& capture, std::uint64_t seed) {
  return Mutator{capture, seed}.run();
}

}  // namespace stormproof::fuzzing

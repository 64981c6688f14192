// Which messages fit, and what a packet weighs.
#include "model/cyclone/packer.hpp"

#include <utility>

#include "model/cyclone/endpoints.hpp"

namespace stormproof::model::cyclone {

namespace {

/// Sets of several addresses are never equal, nor are those of announcements that are not the
/// group, but the readers of a writer are themselves as long as nobody matches.
bool same_destination(const Destination& a, const Destination& b) {
  if (a.is_set != b.is_set) return false;
  if (!a.is_set) return a.addresses == b.addresses;
  const bool of_writers = a.writer != UINT32_MAX;
  if (of_writers && a.writer == b.writer && a.version == b.version) return true;
  const bool of_announcements = a.writer == b.writer && !of_writers;
  if (of_announcements && a.addresses.front() != group) return false;
  return a.addresses.size() == 1 && a.addresses == b.addresses;
}

}  // namespace

bool Packer::fits(const Message& message) const {
  if (open_->of_user != message.of_user || !same_destination(open_->to, message.to)) return false;
  const bool repairs = open_->has_retransmission || message.retransmission;
  const Bytes limit = repairs ? sedp_.max_rexmit_message_size : sedp_.max_message_size;
  return open_->bytes + message.bytes <= limit.count();
}

void Packer::put(Message&& message) {
  if (!open_) {
    open_.emplace();
    open_->to = std::move(message.to);
    open_->bytes = header_bytes + (open_->to.is_set ? 0 : destination_bytes);
    open_->of_user = message.of_user;
  }
  open_->bytes += message.bytes;
  open_->is_complete = message.completes;
  open_->has_retransmission = open_->has_retransmission || message.retransmission;
  open_->contents.push_back(std::move(message.content));
}

void Packer::add(Message&& message) {
  if (open_ && !fits(message)) {
    held_ = std::move(message);
  } else {
    put(std::move(message));
  }
}

void Packer::open_held() {
  if (!held_) return;
  put(std::move(*held_));
  held_.reset();
}

Bundle Packer::take_open() {
  Bundle bundle = std::move(*open_);
  open_.reset();
  return bundle;
}

}  // namespace stormproof::model::cyclone

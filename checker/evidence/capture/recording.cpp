// libpcap's capture loop, with a time limit.
#include "checker/evidence/capture/recording.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <pcap/pcap.h>
#include <poll.h>

namespace stormproof::capture {

namespace {

using model::config::InputError;

struct CloseCapture {
  void operator()(pcap_t* handle) const { pcap_close(handle); }
};
struct CloseDump {
  void operator()(pcap_dumper_t* file) const { pcap_dump_close(file); }
};
using LiveCapture = std::unique_ptr<pcap_t, CloseCapture>;
using DumpFile = std::unique_ptr<pcap_dumper_t, CloseDump>;

InputError refused(const std::string& interface, int status, const std::string& why) {
  std::string text = why.empty() ? pcap_statustostr(status) : why;
  if (status == PCAP_ERROR_PERM_DENIED || status == PCAP_ERROR_PROMISC_PERM_DENIED) {
    text =
        "capturing takes the right to open a packet socket; run it with sudo, or give the program "
        "that right once: sudo setcap cap_net_raw+ep \"$(command -v stormproof)\"";
  }
  return {"--interface " + interface, text};
}

}  // namespace

model::config::Result<std::uint64_t> record(
    const Recording& recording, const std::function<bool(std::uint64_t packets)>& progress) {
  constexpr int whole_packets = 262'144;
  constexpr int buffer_bytes = 16 << 20U;
  constexpr int wake_up_ms = 100;
  std::array<char, PCAP_ERRBUF_SIZE> why{};
  const LiveCapture handle{pcap_create(recording.interface.c_str(), why.data())};
  if (!handle) return InputError{"--interface " + recording.interface, why.data()};
  pcap_set_snaplen(handle.get(), whole_packets);
  pcap_set_buffer_size(handle.get(), buffer_bytes);
  pcap_set_timeout(handle.get(), wake_up_ms);
  pcap_set_tstamp_precision(handle.get(), PCAP_TSTAMP_PRECISION_NANO);
  if (const int status = pcap_activate(handle.get()); status < 0) {
    return refused(recording.interface, status, pcap_geterr(handle.get()));
  }
  // Fragments other than the first have no ports, but are UDP. IGMP says who listens to a group.
  bpf_program filter{};
  if (pcap_compile(handle.get(), &filter, "udp or igmp or (ip6 and ip6[6] == 44)", 1,
                   PCAP_NETMASK_UNKNOWN) == 0) {
    pcap_setfilter(handle.get(), &filter);
    pcap_freecode(&filter);
  }
  // Without packets a blocking read may wait for ever, whatever the timeout.
  pcap_setnonblock(handle.get(), 1, why.data());
  DumpFile file{pcap_dump_open(handle.get(), recording.path.c_str())};
  if (!file) return InputError{"--recording " + recording.path, pcap_geterr(handle.get())};
  pcap_dump_flush(file.get());  // whoever waits for the recording sees that it has begun

  const auto end =
      std::chrono::steady_clock::now() + std::chrono::nanoseconds{recording.duration.count()};
  std::uint64_t packets = 0;
  while (std::chrono::steady_clock::now() < end && progress(packets)) {
    constexpr int at_once = 10'000;
    pollfd ready{pcap_get_selectable_fd(handle.get()), POLLIN, 0};
    static_cast<void>(poll(&ready, 1, wake_up_ms));
    const int some =
        pcap_dispatch(handle.get(), at_once, pcap_dump, reinterpret_cast<u_char*>(file.get()));
    if (some == PCAP_ERROR) return refused(recording.interface, some, pcap_geterr(handle.get()));
    if (some <= 0) continue;
    packets += static_cast<std::uint64_t>(some);
    if (pcap_dump_flush(file.get()) != 0) {
      return InputError{"--recording " + recording.path, "cannot be written to its end"};
    }
    const auto bytes = static_cast<std::uint64_t>(pcap_dump_ftell64(file.get()));
    if (bytes < recording.most_bytes / 2) continue;
    file.reset();
    std::error_code error;
    std::filesystem::rename(recording.path, recording.older(), error);
    file.reset(error ? nullptr : pcap_dump_open(handle.get(), recording.path.c_str()));
    if (!file) return InputError{"--recording " + recording.path, "cannot be begun anew"};
  }
  return packets;
}

}  // namespace stormproof::capture

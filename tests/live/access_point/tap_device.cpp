// The kernel's interface to TAP devices.
#include "tests/live/access_point/tap_device.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace stormproof::live {

namespace {

constexpr const char* tun_path = "/dev/net/tun";

/// Frames that the kernel keeps until this process reads them. More than any burst while the
/// process does not run: what is dropped there never reaches the channel.
constexpr int kernel_queue_frames = 16'384;

ifreq named(const std::string& name) {
  ifreq request{};
  std::memcpy(request.ifr_name, name.data(), name.size());
  return request;
}

/// Sets one property of the interface through any socket; errno tells of failure.
bool configure(unsigned long property, ifreq request) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return false;
  const bool done = ioctl(handle, property, &request) == 0;
  const int reason = errno;
  close(handle);
  errno = reason;
  return done;
}

}  // namespace

model::config::Result<TapDevice, std::string> TapDevice::create(const std::string& name,
                                                                std::int64_t mtu_bytes) {
  const auto failed = [&name](const std::string& what) {
    const bool rights = errno == EPERM || errno == EACCES;
    return fmt::format("{}: {}: {}{}", name, what, std::strerror(errno),
                       rights ? " (it needs root, or CAP_NET_ADMIN)" : "");
  };
  if (name.empty() || name.size() >= IFNAMSIZ) {
    return fmt::format("'{}' cannot name an interface; expected 1 to {} bytes", name, IFNAMSIZ - 1);
  }
  const int descriptor = open(tun_path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return failed(fmt::format("cannot open {}", tun_path));
  TapDevice device{descriptor, name};

  ifreq request = named(name);
  request.ifr_flags = static_cast<short>(IFF_TAP | IFF_NO_PI | IFF_TUN_EXCL);
  if (ioctl(descriptor, TUNSETIFF, &request) != 0) return failed("cannot create the TAP device");
  request = named(name);
  request.ifr_mtu = static_cast<int>(mtu_bytes);
  if (!configure(SIOCSIFMTU, request)) return failed(fmt::format("cannot set MTU {}", mtu_bytes));
  request = named(name);
  request.ifr_qlen = kernel_queue_frames;
  if (!configure(SIOCSIFTXQLEN, request)) return failed("cannot set the transmit queue");
  return device;
}

TapDevice::TapDevice(TapDevice&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}, name_{std::move(other.name_)} {}

TapDevice::~TapDevice() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<std::size_t> TapDevice::read(std::span<std::byte> buffer) const {
  const ssize_t bytes = ::read(descriptor_, buffer.data(), buffer.size());
  if (bytes < 0) return std::nullopt;
  return static_cast<std::size_t>(bytes);
}

bool TapDevice::write(std::span<const std::byte> frame) const {
  return ::write(descriptor_, frame.data(), frame.size()) == static_cast<ssize_t>(frame.size());
}

}  // namespace stormproof::live

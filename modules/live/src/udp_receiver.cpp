// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/udp_receiver.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kLargestPacket = 65536;
// Half a second of the fastest sensors; the system may allow less.
constexpr int kWaitingBytes = 16 * 1024 * 1024;

std::runtime_error failed(std::uint16_t port, const char* what)
{
  return std::runtime_error(
      "UDP port " + std::to_string(port) + ": " + what + " (" + std::strerror(errno) + ")");
}

FileDescriptor boundSocket(std::uint16_t port)
{
  FileDescriptor handle(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!handle.isOpen()) throw failed(port, "no socket");
  const int on = 1;
  setsockopt(handle.get(), SOL_SOCKET, SO_RCVBUF, &kWaitingBytes, sizeof kWaitingBytes);
  setsockopt(handle.get(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  if (bind(handle.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw failed(port, "cannot be listened on");
  return handle;
}

std::uint16_t portOf(int handle)
{
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

std::int64_t nanoseconds(const timespec& time)
{
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

/** When the system got the packet; now, if it does not say. */
std::int64_t arrivalOf(msghdr& message)
{
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part))
    if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS)
      std::memcpy(&time, CMSG_DATA(part), sizeof time);
  return nanoseconds(time);
}
}  // namespace

std::uint16_t udpPort(std::string_view text)
{
  const auto port = parsed<std::uint16_t>(text);
  if (!port || *port == 0)
    throw std::invalid_argument(
        "'" + printable(text) + "' is no UDP port; give a whole number from 1 to 65535");
  return *port;
}

UdpReceiver::UdpReceiver(const std::vector<std::uint16_t>& ports) : bytes_(kLargestPacket)
{
  for (const std::uint16_t port : ports)
  {
    sockets_.push_back(boundSocket(port));
    ports_.push_back(portOf(sockets_.back().get()));
  }
}

std::optional<UdpPacket> UdpReceiver::next(std::chrono::milliseconds patience)
{
  std::vector<pollfd> waiting;
  for (const FileDescriptor& handle : sockets_)
    waiting.push_back({handle.get(), POLLIN, 0});
  if (poll(waiting.data(), waiting.size(), static_cast<int>(patience.count())) <= 0)
    return std::nullopt;
  for (std::size_t i = 0; i < waiting.size(); ++i)
  {
    const std::size_t index = (first_ + i) % waiting.size();
    if ((waiting[index].revents & POLLIN) == 0) continue;
    if (auto packet = receive(index))
    {
      first_ = index + 1;
      return packet;
    }
  }
  return std::nullopt;
}

std::optional<UdpPacket> UdpReceiver::receive(std::size_t index)
{
  sockaddr_in sender{};
  iovec bytes{bytes_.data(), bytes_.size()};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_name = &sender;
  message.msg_namelen = sizeof sender;
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = recvmsg(sockets_[index].get(), &message, 0);
  if (size < 0) return std::nullopt;
  std::array<char, INET_ADDRSTRLEN> address{};
  inet_ntop(AF_INET, &sender.sin_addr, address.data(), address.size());
  UdpPacket packet;
  packet.source = address.data();
  packet.port = ports_[index];
  packet.stamp_ns = arrivalOf(message);
  packet.data = bytes_.data();
  packet.size = static_cast<std::size_t>(size);
  return packet;
}

}  // namespace fastlio

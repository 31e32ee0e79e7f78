// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <optional>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/baud_rates.hpp"
#include "plugins/controller/common/stream/endpoint.hpp"
#include "plugins/controller/common/stream/retry.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int hardware_bytes = 16;  // capacity of a usual UART

/// A serial device of this machine. It has one client, at the other end of the line. Opened again when it comes back.
class Serial final : public Endpoint, private IoThread::Source {
 public:
  explicit Serial(const EndpointSetup& setup)
      : setup_(setup), retry_(setup.io, [this] { open_again(); }), rate_change_(setup.io, [this] { change_rate(); }) {}
  ~Serial() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void open() override { open_device(); }
  void start() override {
    setup_.connections.on_closed = [this](bool) { retry_.later(); };
    serve();
  }
  void close() override {
    retry_.stop();
    rate_change_.stop();
  }
  void set_baud(std::uint32_t baud) override {
    wanted_ = baud;
    setup_.io.signal(*this);
  }

 private:
  void serve() {
    if (!setup_.connections.add(std::exchange(descriptor_, -1), Connection::Descriptor::terminal)) retry_.later();
  }
  void open_again() {
    try {
      open_device();
    } catch (const Error& e) {
      if (!is_told_) setup_.log(LogLevel::warning, std::string(e.what()) + "; it is opened when it is there again");
      is_told_ = true;
      retry_.later();
      return;
    }
    is_told_ = false;
    serve();
  }

  void on_signal() override {
    empty_since_.reset();
    change_rate();
  }
  /// Changes the bit rate now, or after all bytes for the old rate have left the hardware. Never waits, because all
  /// streams share this thread.
  void change_rate() {
    const std::uint32_t baud = wanted_;  // bytes sent before this was set are in the exchange by now
    setup_.connections.on_signal();      // and has_output() counts them from here on
    const auto speed = baud == 0 ? first_speed_ : speed_code(baud);
    if (speed == speed_) return;
    if (!speed)
      return setup_.log(LogLevel::warning, "a serial device cannot run at " + std::to_string(baud) + " bit/s");
    const int device = ::open(setup_.address.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    const Clock::duration delay = time_to_wait(device);
    if (delay > Clock::duration::zero())
      rate_change_.later(delay);
    else
      set_speed(device, *speed);
    if (device >= 0) ::close(device);
  }

  /// Returns the time until the hardware has sent all. When a driver does not report this, bytes that it has taken from
  /// the queue get the time of `hardware_bytes`.
  Clock::duration time_to_wait(int device) {
    const auto has_bytes = [&] {
      int queued = 0;
      return setup_.connections.has_output() || (::ioctl(device, TIOCOUTQ, &queued) == 0 && queued > 0);
    };
    int line_status = 0;
    const bool tells_when_empty = ::ioctl(device, TIOCSERGETLSR, &line_status) == 0;
    if (has_bytes() || (tells_when_empty && (line_status & TIOCSER_TEMT) == 0)) {
      empty_since_.reset();
      return std::chrono::milliseconds(1);
    }
    if (tells_when_empty || device < 0) return {};
    const auto now = Clock::now();
    if (!empty_since_) empty_since_ = now;
    const std::chrono::nanoseconds byte_time(10'000'000'000 / rate_of(*speed_));
    return *empty_since_ + hardware_bytes * byte_time - now;
  }

  void set_speed(int device, speed_t speed) {
    speed_ = speed;  // also used when the device is opened again
    termios settings{};
    if (::tcgetattr(device, &settings) != 0) return;
    ::cfsetspeed(&settings, speed);
    ::tcsetattr(device, TCSANOW, &settings);
  }

  void open_device() {
    const std::string& path = setup_.address.path;
    descriptor_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0)
      fail(system_reason(errno) +
           (errno == EACCES ? "; on many systems users of the group `dialout` may open it" : ""));
    if (::isatty(descriptor_) == 0) fail("it is no serial device");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) fail("another program has locked it");
    configure();
  }

  /// Sets eight bits, no parity, one stop bit, no flow control and unchanged bytes.
  void configure() {
    termios settings{};
    if (::tcgetattr(descriptor_, &settings) != 0) fail(system_reason(errno));
    ::cfmakeraw(&settings);
    settings.c_cflag &= ~tcflag_t(CSTOPB | CRTSCTS);
    settings.c_cflag |= CREAD | CLOCAL;
    settings.c_iflag |= IGNBRK;
    if (!first_speed_) first_speed_ = speed_code(setup_.address.baud);
    if (!first_speed_) first_speed_ = ::cfgetospeed(&settings);
    if (!speed_) speed_ = first_speed_;
    ::cfsetspeed(&settings, *speed_);
    if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0) fail(system_reason(errno));
    termios found{};
    if (setup_.address.baud > 0 && (::tcgetattr(descriptor_, &found) != 0 || ::cfgetospeed(&found) != *speed_))
      fail("it does not run at " + std::to_string(setup_.address.baud) + " bit/s");
    ::tcflush(descriptor_, TCIOFLUSH);
  }

  [[noreturn]] void fail(const std::string& why) {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    throw Error("stream " + quote(setup_.name) + " cannot open serial device " + quote(setup_.address.path) + ": " +
                why);
  }

  const EndpointSetup setup_;
  Retry retry_;
  Retry rate_change_;
  std::optional<Clock::time_point> empty_since_;  ///< when the queue of bytes for the old rate became empty
  std::optional<speed_t> first_speed_;            ///< rate of the address, else the rate that was found
  std::optional<speed_t> speed_;                  ///< present rate
  std::atomic<std::uint32_t> wanted_ = 0;         ///< bit/s; 0: the first
  int descriptor_ = -1;
  bool is_told_ = false;
};

}  // namespace

std::unique_ptr<Endpoint> make_serial(const EndpointSetup& setup) { return std::make_unique<Serial>(setup); }

}  // namespace muro::stream

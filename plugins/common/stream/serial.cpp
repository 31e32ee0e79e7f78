// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#include "plugins/common/stream/baud_rates.hpp"
#include "plugins/common/stream/endpoint.hpp"
#include "plugins/common/stream/retry.hpp"
#include "plugins/common/stream/system_error.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::stream {

namespace {

/// A serial device of this machine: one client, at the other end of the line. Opened again when it comes back.
class Serial final : public Endpoint {
 public:
  explicit Serial(const EndpointSetup& setup) : setup_(setup), retry_(setup.io, [this] { open_again(); }) {}
  ~Serial() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void open() override { open_device(); }
  void start() override {
    setup_.connections.on_closed = [this](bool) { retry_.later(); };
    serve();
  }
  void close() override { retry_.stop(); }

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

  /// Eight bits, no parity, one stop bit, no flow control; bytes as they are.
  void configure() {
    termios settings{};
    if (::tcgetattr(descriptor_, &settings) != 0) fail(system_reason(errno));
    ::cfmakeraw(&settings);
    settings.c_cflag &= ~tcflag_t(CSTOPB | CRTSCTS);
    settings.c_cflag |= CREAD | CLOCAL;
    settings.c_iflag |= IGNBRK;
    const auto speed = speed_code(setup_.address.baud);
    if (speed) ::cfsetspeed(&settings, *speed);
    if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0) fail(system_reason(errno));
    termios found{};
    if (speed && (::tcgetattr(descriptor_, &found) != 0 || ::cfgetospeed(&found) != *speed))
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
  int descriptor_ = -1;
  bool is_told_ = false;
};

}  // namespace

std::unique_ptr<Endpoint> make_serial(const EndpointSetup& setup) { return std::make_unique<Serial>(setup); }

}  // namespace muro::stream

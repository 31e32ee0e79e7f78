// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/claim.hpp"
#include "plugins/controller/common/stream/endpoint.hpp"
#include "plugins/controller/common/stream/in_a_team.hpp"
#include "plugins/controller/common/stream/pty_link.hpp"
#include "plugins/controller/common/stream/pty_watch.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

/// A pseudo-terminal. This process has its master; clients open the terminal, one after the other.
///
/// This class keeps no descriptor of the terminal itself open. So the system reports when the last client has closed
/// it. A device can then react, as to the line DTR of a real port. PtyWatch detects when the terminal is opened.
/// Settings of a client, such as its bit rate, stay, as with other devices.
class Pty final : public Endpoint {
 public:
  explicit Pty(const EndpointSetup& setup) : setup_(setup), link_(setup.address.path) {}
  ~Pty() override { close_master(); }

  void open() override {
    if (!claim_.take(setup_.address.path)) fail(pty_is_taken());
    if (const std::string obstacle = link_.obstacle(); !obstacle.empty()) fail(obstacle);
    watch_ = PtyWatch::shared(setup_.io);
    create();
    setup_.log(LogLevel::info, "serves on " + setup_.address.text() + ", which is " + terminal_);
  }
  void start() override {
    setup_.connections.on_closed = [this](bool by_us) { client_left(by_us); };
    wait();
  }
  void close() override {
    watch_->forget(master_);
    watch_.reset();
    link_.remove();
  }

 private:
  /// Makes a new terminal under our name. When that fails, the earlier terminal stays.
  void create() {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    try {
      prepare(master);
    } catch (...) {
      if (master >= 0) ::close(master);
      throw;
    }
    close_master();
    master_ = master;
  }
  void prepare(int master) {
    char name[128];
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0 || ::ptsname_r(master, name, sizeof name) != 0)
      fail(errno == ENOSPC ? "the system has no more pseudo-terminals; see /proc/sys/kernel/pty/max"
                           : system_reason(errno));
    const bool is_raw = with_terminal(name, [](int terminal) {
      termios settings{};
      ::tcgetattr(terminal, &settings);
      ::cfmakeraw(&settings);
      settings.c_cflag |= CREAD | CLOCAL;
      ::tcsetattr(terminal, TCSANOW, &settings);
    });
    if (!is_raw) fail(system_reason(errno));
    if (const int error = link_.point_to(name); error != 0)
      fail("the link to it cannot be made: " + reason_at(setup_.address.path, error));
    terminal_ = name;
  }

  /// Opens the terminal for a moment. Returns false when it cannot be opened.
  template <class Work>
  static bool with_terminal(const std::string& name, const Work& work) {
    const int terminal = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (terminal < 0) return false;
    work(terminal);
    ::close(terminal);
    return true;
  }

  void wait() {
    watch_->wait(master_, [this] { client_came(); });
  }
  void client_came() {
    const int copy = ::fcntl(master_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0 || !setup_.connections.add(copy, Connection::Descriptor::terminal)) wait();
  }

  void client_left(bool by_us) {
    // The next client must not get unread bytes of this one, and must be able to open the terminal.
    const bool is_free = !(by_us && has_client(master_)) && with_terminal(terminal_, [](int terminal) {
      ::tcflush(terminal, TCIFLUSH);
      ::ioctl(terminal, TIOCNXCL);
    });
    if (!is_free) hang_up();
    wait();
  }
  /// Replaces this terminal by a new one under the same name.
  void hang_up() {
    try {
      create();
    } catch (const Error& e) {
      setup_.log(LogLevel::error, e.what());
    }
  }

  void close_master() {
    if (master_ >= 0) ::close(std::exchange(master_, -1));
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw Error("stream " + quote(setup_.name) + " cannot make pseudo-terminal " + quote(setup_.address.path) + ": " +
                why);
  }

  const EndpointSetup setup_;
  Claim claim_;
  PtyLink link_;
  std::shared_ptr<PtyWatch> watch_;
  int master_ = -1;
  std::string terminal_;
};

}  // namespace

std::unique_ptr<Endpoint> make_pty(const EndpointSetup& setup) { return std::make_unique<Pty>(setup); }

}  // namespace muro::stream

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace muro::stream {

/// TLS of one client: the bytes of its socket on one side, what it says on the other. Does no input and output itself.
class TlsSession {
 public:
  class Impl;
  explicit TlsSession(std::unique_ptr<Impl> impl);
  ~TlsSession();

  /// What the socket has brought.
  void take_in(std::string_view encrypted);
  /// What the client has said of it so far, `most` bytes at most. 0: nothing more, for now or, see below, for good.
  std::size_t read(char* to, std::size_t most);
  bool has_ended() const;   ///< the client has said that it says no more
  bool has_failed() const;  ///< it does not speak TLS, or was interfered with

  /// Whether both sides have agreed on a key, so that something may be written.
  bool is_ready() const;
  void write(std::string_view plain);
  /// Says that nothing more comes. False: that was said before.
  bool end();
  /// What is to go to the socket; empty: nothing.
  std::string take_output();

 private:
  std::unique_ptr<Impl> impl_;
};

/// The certificate with which a server shows who it is.
class TlsServer {
 public:
  /// Files in PEM format: the certificate, with those that vouch for it, and its key, without a passphrase. Throws
  /// muro::Error with the reason of OpenSSL.
  TlsServer(const std::string& certificate, const std::string& key);
  ~TlsServer();

  std::unique_ptr<TlsSession> accept() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace muro::stream

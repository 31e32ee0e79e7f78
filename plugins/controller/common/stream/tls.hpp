// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace muro::stream {

/// TLS of one client, between the encrypted bytes of its socket and the plain bytes. Makes no input or output itself.
class TlsSession {
 public:
  class Impl;
  explicit TlsSession(std::unique_ptr<Impl> impl);
  ~TlsSession();

  /// Takes bytes that were received on the socket.
  void take_in(std::string_view encrypted);
  /// Reads at most `most` plain bytes. Returns 0 when there are none; none will follow after the end or a failure.
  std::size_t read(char* to, std::size_t most);
  bool has_ended() const;   ///< the client has ended its output
  bool has_failed() const;  ///< the client does not speak TLS, or the bytes were changed on the way

  /// Whether both sides have agreed on a key. Only then something may be written.
  bool is_ready() const;
  void write(std::string_view plain);
  /// Ends the output. Returns false when it was ended before.
  bool end();
  /// Returns the bytes to send to the socket; empty when there are none.
  std::string take_output();

 private:
  std::unique_ptr<Impl> impl_;
};

/// The certificate that identifies a server.
class TlsServer {
 public:
  /// Reads files in PEM format: the certificate, with the certificates that vouch for it, and its key, without a
  /// passphrase. Throws muro::Error with the reason of OpenSSL.
  TlsServer(const std::string& certificate, const std::string& key);
  ~TlsServer();

  std::unique_ptr<TlsSession> accept() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace muro::stream

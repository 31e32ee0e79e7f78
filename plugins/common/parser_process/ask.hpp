// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "message.hpp"

namespace muro::parser_process {

struct Question {
  const char* service;  ///< such as "mesh"
  std::string subject;  ///< for messages: "mesh /home/me/wheel.dae"
  const char* needs;    ///< packages that a build with this service needs
  std::string advice;   ///< what to do if the cause is in the file
};

/// Bytes of an answer.
class Answer {
 public:
  Reader reader() const { return Reader({bytes_.get(), size_}); }

 private:
  friend Answer ask(const Question&, std::span<const std::byte>);
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
};

/// Bytes of an answer that all libraries of the program share; aligned for any number.
struct SharedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

/// Lets the parser process answer. All libraries of a program share one process, which is started when it is needed,
/// and again after it has died. Throws muro::Error with the error of the service, or with what has happened to the
/// process and what to do. It may be called from any thread; requests are answered one after the other. [setup]
Answer ask(const Question& question, std::span<const std::byte> request);

/// Asks for a large answer that does not change. Requests for the same `version` of the same thing get the same bytes,
/// while anybody has them. [setup]
SharedBytes ask_shared(const Question& question, std::span<const std::byte> request, const std::string& version);

}  // namespace muro::parser_process

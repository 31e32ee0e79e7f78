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
  const char* needs;    ///< the packages without which muro is built without the service
  std::string advice;   ///< what to do where the file is to blame
};

/// The bytes of an answer.
class Answer {
 public:
  Reader reader() const { return Reader({bytes_.get(), size_}); }

 private:
  friend Answer ask(const Question&, std::span<const std::byte>);
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
};

/// The bytes of an answer that all libraries of the program share; aligned for any number.
struct SharedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

/// Has the parser process answer. All libraries of a program share one process, which is started when it is needed, and
/// again when it has died. Throws muro::Error: what the service says is wrong, or what became of the process and what
/// to do. From any thread; requests follow each other. [setup]
Answer ask(const Question& question, std::span<const std::byte> request);

/// The same for what is large and does not change: who asks for the same `version` of the same gets the same bytes,
/// while anybody has them. [setup]
SharedBytes ask_shared(const Question& question, std::span<const std::byte> request, const std::string& version);

}  // namespace muro::parser_process

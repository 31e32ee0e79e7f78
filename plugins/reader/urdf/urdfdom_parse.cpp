// SPDX-License-Identifier: MIT
#include "urdfdom_parse.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>
#include <vector>

namespace muro::urdf {

namespace {

namespace bridge = console_bridge;

/// Receives the messages of urdfdom during its life. console_bridge has one output for the process, so only one thread
/// may listen at a time.
class Listener final : public bridge::OutputHandler {
 public:
  struct Message {
    std::string text;
    bool is_error;
  };

  Listener() : lock_(one_at_a_time()), before_(bridge::getOutputHandler()), level_before_(bridge::getLogLevel()) {
    bridge::setLogLevel(bridge::CONSOLE_BRIDGE_LOG_WARN);
    bridge::useOutputHandler(this);
  }
  ~Listener() override {
    bridge::useOutputHandler(before_);
    bridge::setLogLevel(level_before_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void log(const std::string& text, bridge::LogLevel level, const char*, int) override {
    messages.push_back({text, level == bridge::CONSOLE_BRIDGE_LOG_ERROR});
  }

  std::vector<Message> messages;

 private:
  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  bridge::OutputHandler* before_;
  bridge::LogLevel level_before_;
};

}  // namespace

std::shared_ptr<const ::urdf::ModelInterface> parse_with_urdfdom(const std::string& xml, Problems& problems) {
  std::shared_ptr<::urdf::ModelInterface> model;
  std::vector<Listener::Message> messages;
  {
    Listener listener;
    try {
      model = ::urdf::parseURDF(xml);
    } catch (const std::exception& e) {
      listener.messages.push_back({e.what(), true});
    }
    messages = std::move(listener.messages);
  }
  for (const auto& [text, is_error] : messages) {
    const std::string report = "urdfdom: " + text;
    is_error ? problems.error({}, report) : problems.warning({}, report);
  }
  if (!model) {
    if (!problems.found_error()) problems.error({}, "urdfdom cannot read the model and gives no reason");
    return nullptr;
  }
  // Links own their children. Without this, freeing a chain of links recurses as deep as the chain is long.
  auto* raw = model.get();
  return {raw, [model = std::move(model)](const ::urdf::ModelInterface*) mutable {
            for (auto& [name, link] : model->links_) {
              link->child_links.clear();
              link->child_joints.clear();
            }
            model.reset();
          }};
}

}  // namespace muro::urdf

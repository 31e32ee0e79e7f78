// SPDX-License-Identifier: MIT
#include "assembly.hpp"

#include <cctype>

namespace muro::sdf {

namespace {

/// The first message when libsdformat cannot say something.
template <class Errors>
bool fine(const Errors& errors, const At& at, Problems& problems) {
  if (errors.empty()) return true;
  problems.error(at, "libsdformat: " + errors.front().Message());
  return false;
}

Pose resolved(const ::sdf::SemanticPose& pose, const std::string& frame, const At& at, Problems& problems) {
  ignition::math::Pose3d p;
  return fine(pose.Resolve(p, frame), at, problems) ? pose_of(p) : Pose{};
}

class Assembler {
 public:
  Assembler(Assembly& out, const Sources& sources, Problems& problems)
      : out_(out), sources_(sources), problems_(problems) {}

  void add_links(const ::sdf::Model& model, const std::string& scope, const Pose& pose) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const ::sdf::Link& link = *model.LinkByIndex(i);
      Body b;
      b.link = &link;
      b.at = at(sources_, link.Element());
      const std::string full = scope + link.Name();
      b.name = out_.unique(plain_name(full), "_");
      b.pose = pose * resolved(link.SemanticPose(), "__model__", b.at, problems_);
      out_.bodies_by_name[full] = int(out_.bodies.size());
      out_.bodies.push_back(std::move(b));
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const ::sdf::Model& inner = *model.ModelByIndex(i);
      const At place = at(sources_, inner.Element());
      add_links(inner,
                scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__", place, problems_));
    }
  }

  void add_joints(const ::sdf::Model& model, const std::string& scope, const Pose& pose) {
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) add_joint(*model.JointByIndex(i), scope, pose);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const ::sdf::Model& inner = *model.ModelByIndex(i);
      const At place = at(sources_, inner.Element());
      add_joints(inner,
                 scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__", place, problems_));
    }
  }

 private:
  void add_joint(const ::sdf::Joint& joint, const std::string& scope, const Pose& pose) {
    Bond b;
    b.joint = &joint;
    b.scope = scope;
    b.at = at(sources_, joint.Element());
    std::string parent, child;
    if (!fine(joint.ResolveParentLink(parent), b.at, problems_) ||
        !fine(joint.ResolveChildLink(child), b.at, problems_))
      return;
    const auto body = [&](const std::string& name) {
      const auto found = out_.bodies_by_name.find(scope + name);
      return found == out_.bodies_by_name.end() ? -1 : found->second;
    };
    b.parent = parent == "world" ? -1 : body(parent);
    b.child = body(child);
    if (b.child < 0 || (b.parent < 0 && parent != "world"))
      return problems_.error(
          b.at, say("joint ", cited(scope + joint.Name()), ": there is no link ", cited(b.child < 0 ? child : parent)));
    if (b.child == b.parent)
      return problems_.error(b.at,
                             say("joint ", cited(scope + joint.Name()), " joins link ", cited(child), " with itself"));
    b.name = out_.unique(plain_name(scope + joint.Name()), "_joint");
    b.pose = pose * resolved(joint.SemanticPose(), "__model__", b.at, problems_);
    out_.joints_by_name[scope + joint.Name()] = int(out_.bonds.size());
    out_.bonds.push_back(std::move(b));
  }

  Assembly& out_;
  const Sources& sources_;
  Problems& problems_;
};

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (name.substr(i).starts_with("::")) {
      plain += '.';
      ++i;
    } else {
      plain += c == '/' || c == ':' || std::isspace(c) || std::iscntrl(c) ? '_' : name[i];
    }
  }
  return plain;
}

Pose pose_of(const ignition::math::Pose3d& p) {
  return {{p.Pos().X(), p.Pos().Y(), p.Pos().Z()},
          Quat(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()).normalized()};
}

Assembly assemble(const ::sdf::Model& model, bool with_joints, const Sources& sources, Problems& problems) {
  Assembly out;
  Assembler assembler(out, sources, problems);
  assembler.add_links(model, "", {});
  if (with_joints) assembler.add_joints(model, "", {});
  return out;
}

}  // namespace muro::sdf

// SPDX-License-Identifier: MIT
#include "assembly.hpp"

#include <cctype>

namespace muro::sdf {

namespace {

/// Reports the first message and returns false if libsdformat could not resolve something.
template <class Errors>
bool is_resolved(const Errors& errors, const FileLocation& location, Problems& problems) {
  if (errors.empty()) return true;
  problems.error(location, "libsdformat: " + errors.front().Message());
  return false;
}

Pose resolved(const ::sdf::SemanticPose& pose, const std::string& frame, const FileLocation& location,
              Problems& problems) {
  ignition::math::Pose3d p;
  return is_resolved(pose.Resolve(p, frame), location, problems) ? pose_of(p) : Pose{};
}

class Assembler {
 public:
  Assembler(Assembly& out, const SourceFiles& sources, Problems& problems)
      : out_(out), sources_(sources), problems_(problems) {}

  void add_links(const ::sdf::Model& model, const std::string& scope, const Pose& pose) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const ::sdf::Link& link = *model.LinkByIndex(i);
      Body b;
      b.link = &link;
      b.location = location_of(sources_, link.Element());
      const std::string full = scope + link.Name();
      b.name = out_.unique(plain_name(full), "_");
      b.pose = pose * resolved(link.SemanticPose(), "__model__", b.location, problems_);
      out_.bodies_by_name[full] = int(out_.bodies.size());
      out_.bodies.push_back(std::move(b));
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const ::sdf::Model& inner = *model.ModelByIndex(i);
      const FileLocation location = location_of(sources_, inner.Element());
      add_links(inner,
                scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__", location, problems_));
    }
  }

  void add_joints(const ::sdf::Model& model, const std::string& scope, const Pose& pose) {
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) add_joint(*model.JointByIndex(i), scope, pose);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const ::sdf::Model& inner = *model.ModelByIndex(i);
      const FileLocation location = location_of(sources_, inner.Element());
      add_joints(inner,
                 scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__", location, problems_));
    }
  }

 private:
  void add_joint(const ::sdf::Joint& joint, const std::string& scope, const Pose& pose) {
    Joint j;
    j.definition = &joint;
    j.scope = scope;
    j.location = location_of(sources_, joint.Element());
    std::string parent, child;
    if (!is_resolved(joint.ResolveParentLink(parent), j.location, problems_) ||
        !is_resolved(joint.ResolveChildLink(child), j.location, problems_))
      return;
    const auto body = [&](const std::string& name) {
      const auto found = out_.bodies_by_name.find(scope + name);
      return found == out_.bodies_by_name.end() ? -1 : found->second;
    };
    j.parent = parent == "world" ? -1 : body(parent);
    j.child = body(child);
    if (j.child < 0 || (j.parent < 0 && parent != "world"))
      return problems_.warning(j.location,
                               concat("joint ", quote(scope + joint.Name()), " is left out: there is no link ",
                                      quote(j.child < 0 ? child : parent)));
    if (j.child == j.parent)
      return problems_.warning(j.location, concat("joint ", quote(scope + joint.Name()), " is left out: it joins link ",
                                                  quote(child), " with itself"));
    j.name = out_.unique(plain_name(scope + joint.Name()), "_joint");
    j.pose = pose * resolved(joint.SemanticPose(), "__model__", j.location, problems_);
    out_.joints_by_name[scope + joint.Name()] = int(out_.joints.size());
    out_.joints.push_back(std::move(j));
  }

  Assembly& out_;
  const SourceFiles& sources_;
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

Assembly assemble(const ::sdf::Model& model, bool with_joints, const SourceFiles& sources, Problems& problems) {
  Assembly out;
  Assembler assembler(out, sources, problems);
  assembler.add_links(model, "", {});
  if (with_joints) assembler.add_joints(model, "", {});
  return out;
}

}  // namespace muro::sdf

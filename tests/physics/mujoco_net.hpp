#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "seine/net/flight.hpp"
#include "seine/net/shape.hpp"
#include "seine/sim/drift.hpp"
#include "seine/sim/net_material.hpp"
#include "seine/sim/net_physics.hpp"

namespace seine::sim {

/// The same net in MuJoCo [Todorov12], to check ours against an engine that shares nothing with it: nodes are
/// balls on sliding joints, cords are tendons with a limit (soft constraints solved together), objects bump
/// into the nodes, which are fat because cords do not collide. One object.
class MujocoNet final : public NetPhysics {
 public:
  static constexpr double kNodeRadius = 0.1;  // m: with less, an object slips between the nodes
  static constexpr double kStep = 2e-3;       // s
  static constexpr double kSettling = 0.8;    // s

  MujocoNet(const net::Net& net, std::span<const geom::Vec3> corners, const NetMaterial& material)
      : mesh_(triangulate(net.rest)), material_(material), pulls_(net.size()) {
    std::vector<geom::Vec2> ground;
    for (const geom::Vec3 corner : corners) ground.push_back(corner.ground());
    nodes_ = drape(mesh_, corners, net::empty_depth(net, ground));
    load(xml());
    move_corners(corners);
    advance(corners, kSettling);
  }
  /// A copy of a net that has swung out: building one takes seconds.
  MujocoNet(const MujocoNet& other)
      : mesh_(other.mesh_),
        material_(other.material_),
        model_(mj_copyModel(nullptr, other.model_.get())),
        data_(mj_copyData(nullptr, model_.get(), other.data_.get())),
        saved_position_(other.saved_position_),
        saved_velocity_(other.saved_velocity_),
        ball_(other.ball_),
        added_(other.added_),
        touching_(other.touching_),
        due_(other.due_),
        nodes_(other.nodes_),
        pulls_(other.pulls_) {}

  std::size_t add(const Ball& ball) override {
    ball_ = ball;
    added_ = true;
    const int body = mj_name2id(model_.get(), mjOBJ_BODY, "ball");
    const double inertia = 0.4 * ball.mass * ball.radius * ball.radius;
    model_->body_mass[body] = ball.mass;
    for (int i = 0; i < 3; ++i) model_->body_inertia[3 * body + i] = inertia;
    model_->geom_size[3 * mj_name2id(model_.get(), mjOBJ_GEOM, "ball")] = ball.radius;
    mj_setConst(model_.get(), data_.get());
    write_state();
    place_ball();
    mj_forward(model_.get(), data_.get());
    return 0;
  }

  void advance(std::span<const geom::Vec3> corners, double duration) override {
    const std::vector<geom::Vec3> start(nodes_.begin(),
                                        nodes_.begin() + static_cast<std::ptrdiff_t>(mesh_.corners));
    due_ += duration;
    while (due_ > 0.5 * kStep) {  // whole steps only: the mean keeps time
      due_ -= kStep;
      hold_ball(drift(start, corners, duration));
      move_corners(corners);
      mj_step(model_.get(), data_.get());
      if (data_->warning[mjWARN_BADQACC].number > 0) throw std::runtime_error("MuJoCo diverged");
      read_state();
    }
  }

  std::size_t balls() const override { return added_ ? 1 : 0; }
  const Ball& ball(std::size_t) const override { return ball_; }
  bool touching(std::size_t) const override { return touching_; }
  const NetMesh& mesh() const override { return mesh_; }
  std::span<const geom::Vec3> nodes() const override { return nodes_; }
  std::span<const geom::Vec3> pulls() const override { return pulls_; }  // not measured

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  void load(const std::string& text) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "net.xml", static_cast<int>(text.size()));
    std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
    char error[300] = "";
    model_.reset(mj_loadXML("net.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (model_ == nullptr) throw std::runtime_error(error);
    data_.reset(mj_makeData(model_.get()));
    saved_position_.assign(data_->qpos, data_->qpos + model_->nq);
    saved_velocity_.assign(static_cast<std::size_t>(model_->nv), 0.0);
  }

  std::string xml() const {
    std::ostringstream out;
    out.precision(17);
    out << "<mujoco><size njmax='8000' nconmax='1000'/><option timestep='" << kStep << "' gravity='0 0 "
        << -net::kGravity << "' solver='CG' iterations='50' tolerance='1e-9'/><worldbody>";
    for (std::size_t v = 0; v < nodes_.size(); ++v) add_node(out, v);
    out << "<body name='ball' pos='100 0 1'><freejoint/><geom name='ball' type='sphere' size='0.08' "
           "mass='0.25' "
        << "contype='1' conaffinity='0' friction='" << material_.friction << " 0.005 0.0001'/></body>"
        << "</worldbody><tendon>";
    for (const Cord& cord : mesh_.cords) {
      out << "<spatial limited='true' range='0 " << cord.rest
          << "' solreflimit='0.01 1' solimplimit='0.99 0.99 0.001'><site site='s" << cord.a
          << "'/><site site='s" << cord.b << "'/></spatial>";
    }
    out << "</tendon></mujoco>";
    return out.str();
  }

  void add_node(std::ostream& out, std::size_t v) const {
    const geom::Vec3 p = nodes_[v];
    const bool corner = v < mesh_.corners;
    const double mass = material_.mass * mesh_.share[v];
    out << "<body name='n" << v << "' pos='" << p.x << ' ' << p.y << ' ' << p.z << "'"
        << (corner ? " mocap='true'>" : ">");
    for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"}) {
      if (!corner)
        out << "<joint type='slide' axis='" << axis << "' damping='" << material_.air * mass << "'/>";
    }
    out << "<geom type='sphere' size='" << kNodeRadius << "' mass='" << mass
        << "' contype='0' conaffinity='1' friction='" << material_.friction << " 0.005 0.0001'/><site name='s"
        << v << "'/></body>";
  }

  void move_corners(std::span<const geom::Vec3> corners) {
    for (std::size_t k = 0; k < mesh_.corners; ++k) {
      data_->mocap_pos[3 * k] = corners[k].x;
      data_->mocap_pos[3 * k + 1] = corners[k].y;
      data_->mocap_pos[3 * k + 2] = corners[k].z;
    }
  }

  // The drag of the net on an object in it, as in CordNet; and no weight before there is an object.
  void hold_ball(const Drift& team) {
    const int body = mj_name2id(model_.get(), mjOBJ_BODY, "ball");
    const geom::Vec3 lost = touching_ ? ball_.velocity + (-1.0) * team.at(ball_.position) : geom::Vec3{};
    const double rate = material_.holding * ball_.mass;
    data_->xfrc_applied[6 * body] = -rate * lost.x;
    data_->xfrc_applied[6 * body + 1] = -rate * lost.y;
    data_->xfrc_applied[6 * body + 2] = -rate * lost.z + (added_ ? 0.0 : net::kGravity * ball_.mass);
  }

  int ball_joint(const int* address) const {
    return address[model_->body_jntadr[mj_name2id(model_.get(), mjOBJ_BODY, "ball")]];
  }

  void place_ball() {
    double* q = data_->qpos + ball_joint(model_->jnt_qposadr);
    double* v = data_->qvel + ball_joint(model_->jnt_dofadr);
    q[0] = ball_.position.x, q[1] = ball_.position.y, q[2] = ball_.position.z;
    v[0] = ball_.velocity.x, v[1] = ball_.velocity.y, v[2] = ball_.velocity.z;
  }

  // mj_setConst resets the data: the state of the net is carried across.
  void write_state() {
    mj_resetData(model_.get(), data_.get());
    std::copy(saved_position_.begin(), saved_position_.end(), data_->qpos);
    std::copy(saved_velocity_.begin(), saved_velocity_.end(), data_->qvel);
    move_corners(std::span(nodes_).first(mesh_.corners));
  }

  void read_state() {
    saved_position_.assign(data_->qpos, data_->qpos + model_->nq);
    saved_velocity_.assign(data_->qvel, data_->qvel + model_->nv);
    for (std::size_t v = 0; v < nodes_.size(); ++v) {
      const int body = mj_name2id(model_.get(), mjOBJ_BODY, ("n" + std::to_string(v)).c_str());
      nodes_[v] = {data_->xpos[3 * body], data_->xpos[3 * body + 1], data_->xpos[3 * body + 2]};
    }
    if (!added_) return;
    const double* q = data_->qpos + ball_joint(model_->jnt_qposadr);
    const double* v = data_->qvel + ball_joint(model_->jnt_dofadr);
    ball_.position = {q[0], q[1], q[2]};
    ball_.velocity = {v[0], v[1], v[2]};
    touching_ = data_->ncon > 0;
  }

  NetMesh mesh_;
  NetMaterial material_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  std::vector<double> saved_position_, saved_velocity_;
  Ball ball_{.position = {100.0, 0.0, 1.0}};
  bool added_ = false, touching_ = false;
  double due_ = 0.0;  // s
  std::vector<geom::Vec3> nodes_, pulls_;
};

}  // namespace seine::sim

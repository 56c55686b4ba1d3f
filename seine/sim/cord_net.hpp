#pragma once

#include <array>
#include <span>
#include <vector>

#include "seine/net/net.hpp"
#include "seine/sim/cloth.hpp"
#include "seine/sim/net_material.hpp"
#include "seine/sim/net_physics.hpp"

namespace seine::sim {

/// The net as a cloth of triangles in extended position-based dynamics [Macklin16], one sweep per short step
/// [Macklin19]. Cords resist stretch only: along the sides of the triangles, and from every node straight to
/// every corner, as cloth that stretches in no direction does. Same input, same bits.
class CordNet final : public NetPhysics {
 public:
  /// The net at rest in the air, hanging from `corners`.
  CordNet(const net::Net& net, std::span<const geom::Vec3> corners, const NetMaterial& material);

  std::size_t add(const Ball& ball) override;
  void advance(std::span<const geom::Vec3> corners, double duration) override;
  std::size_t balls() const override { return bodies_.size(); }
  const Ball& ball(std::size_t index) const override { return bodies_[index].ball; }
  bool touching(std::size_t index) const override { return bodies_[index].touching; }
  const NetMesh& mesh() const override { return mesh_; }
  std::span<const geom::Vec3> nodes() const override { return cloth_.position; }
  std::span<const geom::Vec3> pulls() const override { return pulls_; }

 private:
  void settle();
  void step(std::span<const geom::Vec3> corners, double part, double h);
  void predict(double h);
  void tighten(double h);
  void tighten(std::size_t a, std::size_t b, double rest, double h);
  void tighten_geodesics(std::size_t corner, double h);
  void press(double h);
  void finish(double h);

  NetMesh mesh_;
  NetMaterial material_;
  Cloth cloth_;
  std::vector<Body> bodies_;
  std::vector<geom::Vec3> start_;     // corners when `advance` began
  std::vector<geom::Vec3> pulls_;     // N
  std::vector<geom::Vec3> impulses_;  // N s, since `advance` began
  std::vector<std::size_t> taut_;     // nodes, of one corner
  double longest_step_ = 1e-3;        // s
  bool backwards_ = false;            // sweeps change direction, so that no side of the net is favoured
};

}  // namespace seine::sim

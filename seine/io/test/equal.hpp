#pragma once

#include <gtest/gtest.h>

#include "seine/world/scenario.hpp"

namespace seine::io {

inline void expect_equal_net(const world::Scenario& a, const world::Scenario& b) {
  ASSERT_EQ(a.net.has_value(), b.net.has_value());
  if (a.net) {
    EXPECT_EQ(a.net->rest, b.net->rest);
    ASSERT_EQ(a.net->attachments.size(), b.net->attachments.size());
    for (std::size_t i = 0; i < a.net->attachments.size(); ++i) {
      EXPECT_EQ(a.net->attachments[i].at, b.net->attachments[i].at);
      EXPECT_EQ(a.net->attachments[i].height, b.net->attachments[i].height);
    }
    EXPECT_EQ(a.net->stretch, b.net->stretch);
    EXPECT_EQ(a.net->clearance, b.net->clearance);
    EXPECT_EQ(a.net->rebound, b.net->rebound);
  }
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (std::size_t i = 0; i < a.targets.size(); ++i) {
    const net::Target &t = a.targets[i], &u = b.targets[i];
    EXPECT_EQ(t.time, u.time);
    EXPECT_EQ(t.position, u.position);
    EXPECT_EQ(t.velocity, u.velocity);
    EXPECT_EQ(t.radius, u.radius);
    EXPECT_EQ(t.mass, u.mass);
    EXPECT_EQ(t.drag, u.drag);
    EXPECT_EQ(t.covariance, u.covariance);
  }
  ASSERT_EQ(a.payload.has_value(), b.payload.has_value());
  if (a.payload) {
    EXPECT_EQ(a.payload->radius, b.payload->radius);
    EXPECT_EQ(a.payload->mass, b.payload->mass);
  }
  ASSERT_EQ(a.delivery.has_value(), b.delivery.has_value());
  if (a.delivery) {
    EXPECT_EQ(a.delivery->center, b.delivery->center);
    EXPECT_EQ(a.delivery->radius, b.delivery->radius);
    EXPECT_EQ(a.delivery->heading, b.delivery->heading);
  }
}

/// Equal to the last bit.
inline void expect_equal(const world::Scenario& a, const world::Scenario& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.bounds.low, b.bounds.low);
  EXPECT_EQ(a.bounds.high, b.bounds.high);
  ASSERT_EQ(a.map.has_value(), b.map.has_value());
  EXPECT_EQ(a.outside_free, b.outside_free);
  if (a.map) {
    EXPECT_EQ(a.map->occupied, b.map->occupied);
    EXPECT_EQ(a.map->origin, b.map->origin);
    EXPECT_EQ(a.map->resolution, b.map->resolution);
  }
  EXPECT_EQ(a.margins.robot, b.margins.robot);
  EXPECT_EQ(a.margins.obstacle, b.margins.obstacle);
  ASSERT_EQ(a.models.size(), b.models.size());
  for (std::size_t i = 0; i < a.models.size(); ++i) {
    const vehicle::Model &m = a.models[i], &n = b.models[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.footprint, n.footprint);
    EXPECT_EQ(m.wheelbase, n.wheelbase);
    EXPECT_EQ(m.limits.speed, n.limits.speed);
    EXPECT_EQ(m.limits.reverse_speed, n.limits.reverse_speed);
    EXPECT_EQ(m.limits.acceleration, n.limits.acceleration);
    EXPECT_EQ(m.limits.lateral_acceleration, n.limits.lateral_acceleration);
    EXPECT_EQ(m.limits.steering, n.limits.steering);
    EXPECT_EQ(m.limits.steering_rate, n.limits.steering_rate);
  }
  ASSERT_EQ(a.robots.size(), b.robots.size());
  for (std::size_t i = 0; i < a.robots.size(); ++i) {
    EXPECT_EQ(a.robots[i].name, b.robots[i].name);
    EXPECT_EQ(a.robots[i].model, b.robots[i].model);
    EXPECT_EQ(a.robots[i].start, b.robots[i].start);
    EXPECT_EQ(a.robots[i].goal, b.robots[i].goal);
    EXPECT_EQ(a.robots[i].start_speed, b.robots[i].start_speed);
  }
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    const world::Obstacle &o = a.obstacles[i], &p = b.obstacles[i];
    EXPECT_EQ(o.name, p.name);
    EXPECT_EQ(o.height, p.height);
    ASSERT_EQ(o.shape.index(), p.shape.index());
    if (const auto* circle = std::get_if<world::Circle>(&o.shape)) {
      EXPECT_EQ(circle->center, std::get<world::Circle>(p.shape).center);
      EXPECT_EQ(circle->radius, std::get<world::Circle>(p.shape).radius);
    } else {
      EXPECT_EQ(std::get<0>(o.shape), std::get<0>(p.shape));
    }
    ASSERT_EQ(o.motion.size(), p.motion.size());
    for (std::size_t j = 0; j < o.motion.size(); ++j) {
      EXPECT_EQ(o.motion[j].t, p.motion[j].t);
      EXPECT_EQ(o.motion[j].pose, p.motion[j].pose);
    }
  }
  expect_equal_net(a, b);
}

}  // namespace seine::io

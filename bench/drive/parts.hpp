#pragma once

// The parts of ./dev bench drive: each prints its rows as they come, and the seed of every failure.
namespace seine::bench {

void programmes(int scenes);  ///< the quadratic programme of the tracker, warm
void tracking(int scenes);    ///< tracking error of `random` teams at every noise
void collisions(int scenes);  ///< collisions of `random` teams at noise low
void throws(int scenes);      ///< throws: caught and delivered, every team and noise
void replanning(int scenes);  ///< how often a team with a net gets a new plan while it drives
void speed(int scenes);       ///< of the simulation of a catch
void drops(int objects);      ///< objects dropped onto a still net
void flights();               ///< where measured flights end, foretold

}  // namespace seine::bench

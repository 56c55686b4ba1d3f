#pragma once

// The parts of ./dev bench drive: each prints its rows as they come, and the seed of every failure.
namespace seine::bench {

void programmes(int runs);  ///< the quadratic programme of the tracker, warm
void tracking(int runs);    ///< tracking error of `random` teams at every noise
void collisions(int runs);  ///< collisions of `random` teams at noise low
void throws(int runs);      ///< throws: caught and delivered, every team and noise
void replanning(int runs);  ///< how often a team with a net gets a new plan while it drives
void speed(int runs);       ///< of the simulation of a catch
void drops(int runs);       ///< objects dropped onto a still net
void flights();             ///< where measured flights end, foreseen

}  // namespace seine::bench

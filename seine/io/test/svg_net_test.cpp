// Pictures of teams with a net: what must be in them, not how it looks.
#include <gtest/gtest.h>

#include <string>

#include "seine/io/scenario_file.hpp"
#include "seine/io/svg.hpp"

namespace seine::io {
namespace {

constexpr const char* kTask = R"(seine: 1
world:
  bounds: [-4, -4, 12, 8]
  obstacles:
    - {polygon: [[4.6, 1.3], [5.5, 1.3], [5.1, 2.2]], height: 0.15}
    - {polygon: [[4, -2], [5, -2.2], [4.8, -1]], height: 1.5}
robots:
  - {start: {x: 0.894, y: 0, heading: 0}}
  - {start: {x: -0.747, y: 0.947, heading: 0}}
  - {start: {x: -0.747, y: -0.947, heading: 0}}
net: {regular: {side: 2.2}}
)";

constexpr const char* kThrow = R"(
targets: [{time: 0.8, position: [4.8, 5.4, 1.5], velocity: [-1.9, -3.3, 4.5]}]
delivery: {center: [8.5, 1], heading: 0.5}
)";

std::string picture(const std::string& text) {
  return svg_text(parse_scenario(text, "task.yaml", "."), nullptr);
}

bool has(const std::string& svg, const std::string& part) {
  return svg.find(part) != std::string::npos;
}

// Stand-ins for a reader of XML: every tag that opens is closed.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(SvgNet, ShowsTheNetTheThrowAndTheDelivery) {
  const std::string svg = picture(std::string(kTask) + kThrow);
  for (const char* word :
       {">net<", ">target, caught<", ">delivery<", ">low obstacle<", ">obstacle<", ">0.15 m<"})
    EXPECT_TRUE(has(svg, word)) << word;
  EXPECT_TRUE(has(svg, ">1.82 s<"));  // when it falls through the rim
  EXPECT_FALSE(has(svg, ">1.5 m<"));  // taller than the rim: no way over it
  EXPECT_FALSE(has(svg, ">goal<"));
  EXPECT_FALSE(has(svg, ">payload<"));
  EXPECT_FALSE(has(svg, "nan"));
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
}

TEST(SvgNet, ShowsThePayloadWhereItHangs) {
  const std::string with = picture(std::string(kTask) + "payload: {radius: 0.2}\n");
  const std::string without = picture(kTask);
  EXPECT_TRUE(has(with, ">payload<"));
  EXPECT_EQ(count(with, "<circle"), count(without, "<circle") + 2);  // the ball, and the legend's
  EXPECT_TRUE(has(without, ">net<"));
}

TEST(SvgNet, ATeamWithoutANetShowsNone) {
  const std::string svg = picture(
      "seine: 1\nworld: {bounds: [-5, -5, 5, 5]}\nrobots: [{start: {x: 0, y: 0, heading: 0}, goal: {x: 2, y: "
      "0, "
      "heading: 0}}]\n");
  EXPECT_FALSE(has(svg, ">net<"));
  EXPECT_TRUE(has(svg, ">goal<"));
}

}  // namespace
}  // namespace seine::io

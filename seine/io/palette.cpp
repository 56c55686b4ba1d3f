#include "seine/io/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seine::io {
namespace {

constexpr std::array kChosen{"#2f6fde", "#e4572e", "#149c6b", "#9b51e0", "#e09400",
                             "#d6336c", "#0a98b8", "#76890c", "#8d5a3b", "#4c5fb8"};

int channel(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255.0 * encoded));
}

/// Lightness, chroma and hue of the OKLab space (B. Ottosson, 2020) as sRGB: equal lightness looks equally
/// light in every hue.
std::string oklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const int rgb[3] = {channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                      channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                      channel(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
  std::string text = "#";
  for (const int value : rgb) {
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

}  // namespace

std::string car_colour(std::size_t index) {
  if (index < kChosen.size()) return kChosen[index];
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double lightness = index % 2 == 0 ? 0.55 : 0.66;
  return oklch(lightness, 0.15, std::fmod(golden * static_cast<double>(index), 2.0 * std::numbers::pi));
}

}  // namespace seine::io

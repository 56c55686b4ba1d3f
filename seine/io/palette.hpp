#pragma once

#include <cstddef>
#include <string>

namespace seine::io {

/// A colour for car `index`, "#rrggbb": ten chosen ones, then hues a golden angle apart at two lightnesses.
std::string car_colour(std::size_t index);

}  // namespace seine::io

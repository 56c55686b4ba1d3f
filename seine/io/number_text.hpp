#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace seine::io {

/// The shortest decimal text that reads back as the same double; ".inf", "-.inf" and ".nan" as YAML writes
/// them.
std::string number_text(double value);

/// `value` with at most `digits` decimals, trailing zeros dropped: for pictures and tables, not for round
/// trips.
std::string rounded_text(double value, int digits);

/// The number that is all of `text` (decimal, optional sign and exponent), where it is finite.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

}  // namespace seine::io

/* Decimal to double and back, exactly, by the C++ library. */
#include "formats/numbers.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

const char *
mr_real_read(const char *p, const char *end, double *x)
{
	const char *begin = p < end && *p == '+' ? p + 1 : p,
		   *digits = begin + (begin == p && p < end && *p == '-');

	if (digits == end || (*digits != '.' && (*digits < '0' || *digits > '9'))) /* infinity is no number */
		return nullptr;
	auto [behind, error] = std::from_chars(begin, end, *x);
	if (error == std::errc::invalid_argument)
		return nullptr;
	if (error == std::errc::result_out_of_range) /* infinity, or nearly zero */
		*x = std::strtod(std::string(begin, behind).c_str(), nullptr);
	return behind;
}

char *
mr_real_write(char *to, double x)
{
	double size = std::fabs(x);
	bool plain = size == 0 || (size >= 1e-5 && size < 1e17);

	return std::to_chars(
	    to, to + MR_REAL_MAX, x, plain ? std::chars_format::fixed : std::chars_format::scientific)
	    .ptr;
}

char *
mr_count_write(char *to, uint64_t n)
{
	return std::to_chars(to, to + MR_REAL_MAX, n).ptr;
}

/* Numbers as text: reading equals strtod bit for bit, writing is read back, and is as short as can be. */
#include "base/random.h"
#include "formats/scan.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static uint64_t
bits_of(double x)
{
	uint64_t b;

	memcpy(&b, &x, sizeof b);
	return b;
}

static double
random_bits(mr_random *r)
{
	double x;

	do {
		uint64_t b = mr_random_bits(r);
		memcpy(&x, &b, sizeof x);
	} while (!isfinite(x));
	return x;
}

/* Reads the text from memory of exactly its size, so that a sanitizer sees a look behind its end. */
static void
same_as_strtod(const char *text)
{
	size_t n = strlen(text);
	char *copy = malloc(n ? n : 1);
	const char *end;
	double x = -1, y = strtod(text, NULL);

	assert_non_null(copy);
	memcpy(copy, text, n);
	end = mr_real_read(copy, copy + n, &x);
	if (end != copy + n || bits_of(x) != bits_of(y))
		print_message("# %s: %.17g, strtod %.17g\n", text, x, y);
	assert_ptr_equal(end, copy + n);
	assert_true(bits_of(x) == bits_of(y));
	free(copy);
}

static void
known(void **state)
{
	static const char *const texts[] = { "0", "-0", "+0", "0.0", "-0.0e5", "1", ".5", "5.", "-.5e-3",
		"1e0", "1e-0", "1E+5", "9007199254740993", "9007199254740992.5",
		"9007199254740993.0000000000000000000000001", "9007199254740992.9999999999999999999999999",
		"18446744073709551615", "18446744073709551616", "9999999999999999999", "99999999999999999999",
		"123456789012345678901234567890", "1e22", "1e23", "8.5e22", "1e27", "1e28", "1e-27", "1e-28",
		"9999999999999999999e27", "9999999999999999999e-27", "1e308", "1.7976931348623157e308",
		"1.7976931348623159e308", "1e309", "-1e400", "2.2250738585072014e-308",
		"2.2250738585072011e-308", "4.9e-324", "2e-324", "1e-400", "0e999999999",
		"1e99999999999999999999", "0.000000000000000000000000000000000000000001e42",
		"100000000000000000000000000000000000000000e-41", "6.8980247e-310", "0.1", "0.2", "0.3",
		"123456.789e-5", "-000000000000000000000001.5" };

	(void)state;
	for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
		same_as_strtod(texts[i]);
}

static void
not_numbers(void **state)
{
	static const char *const texts[] = { "", "-", "+", ".", "-.", "e5", "nan", "inf", "x", "--1", "- 1" };

	(void)state;
	for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
		double x;
		assert_null(mr_real_read(texts[i], texts[i] + strlen(texts[i]), &x));
	}
}

/* Where a number ends is told, whatever follows. */
static void
ends(void **state)
{
	static const struct {
		const char *text;
		size_t bytes;
	} cases[] = { { "1,5", 1 }, { "1.5.5", 3 }, { "1-2", 1 }, { "1e5e5", 3 }, { "1/2", 1 },
		{ "0x10", 1 } };

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const char *t = cases[i].text;
		double x;
		assert_int_equal(mr_real_read(t, t + strlen(t), &x) - t, cases[i].bytes);
	}
}

/* Digits at random: of any number, with a point and an exponent anywhere near. */
static void
random_texts(void **state)
{
	mr_random r = { 1 };
	char text[64];

	(void)state;
	for (int i = 0; i < 500000; i++) {
		size_t digits = 1 + mr_random_bits(&r) % 24, point = mr_random_bits(&r) % 30, n = 0;
		if (mr_random_bits(&r) & 1)
			text[n++] = '-';
		for (size_t k = 0; k < digits; k++) {
			if (k == point)
				text[n++] = '.';
			text[n++] = (char)('0' + mr_random_bits(&r) % 10);
		}
		text[n] = 0;
		if (mr_random_bits(&r) & 1)
			snprintf(text + n, sizeof text - n, "e%d", (int)(mr_random_bits(&r) % 60) - 30);
		same_as_strtod(text);
	}
}

/* Values halfway between two doubles, and a hair beside: the hardest to round. */
static void
halfway(void **state)
{
	mr_random r = { 2 };
	char text[1100];

	(void)state;
	for (int i = 0; i < 100000; i++) {
		uint64_t m = (mr_random_bits(&r) >> 11) | UINT64_C(1) << 52;
		int e = (int)(mr_random_bits(&r) % 12) - 10;
		snprintf(text, sizeof text, "%.*Lf", e < 0 ? 1 - e : 1, ldexpl((long double)m + 0.5L, e));
		same_as_strtod(text);
		if (strlen(text) < 60) {
			strncat(text, "0000000000000000000000001", 30);
			same_as_strtod(text);
		}
	}
}

static void
round_trip(double x)
{
	char text[MR_REAL_MAX + 1], shortest[40];
	char *end = mr_real_write(text, x);
	double y;

	assert_true(end - text <= MR_REAL_MAX);
	*end = 0;
	assert_ptr_equal(mr_real_read(text, end, &y), end);
	if (bits_of(x) != bits_of(y))
		print_message("# %.17g is written %s\n", x, text);
	assert_true(bits_of(x) == bits_of(y));
	for (int digits = 1; digits <= 17; digits++) {
		snprintf(shortest, sizeof shortest, "%.*e", digits - 1, x);
		if (strtod(shortest, NULL) == x) {
			int written = 0;
			const char *p = text;
			for (; *p == '-' || *p == '0' || *p == '.'; p++)
				;
			for (; *p && *p != 'e'; p++)
				written += *p != '.';
			if (x == floor(x) && fabs(x) < 1e17)
				return; /* zeros before the point count for nothing */
			if (written > (digits < 15 ? 15 : digits))
				print_message("# %s has %d digits, %d do\n", text, written, digits);
			assert_true(written <= (digits < 15 ? 15 : digits));
			return;
		}
	}
}

static void
written(void **state)
{
	static const double some[] = { 0, -0.0, 1, -1, 0.1, 0.5, 1e15, 1e16, 1e17, 1e22, 1e23, 123456789,
		0.001, 1e-4, 1e-5, 1e-9, 9.999999999999999e-10, 1e-10, 999.9999999999999, 1000.0000000000001,
		9007199254740993.0, 1e-300, DBL_MAX, DBL_MIN, DBL_TRUE_MIN, 5e-324, 0.30000000000000004,
		2.0 / 3, 1.0 / 3, 99999999999999.98 };
	mr_random r = { 3 };

	(void)state;
	for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
		round_trip(some[i]);
		round_trip(-some[i]);
	}
	for (int i = -320; i <= 308; i++) {
		round_trip(nextafter(pow(10, i), 0));
		round_trip(nextafter(pow(10, i), INFINITY));
	}
	round_trip(999999999999999.9);
	for (int i = 0; i < 50000; i++) {
		double u = mr_random_real(&r);
		round_trip(u);
		round_trip((double)(float)(u - 0.5));
		round_trip(floor(u * 1e6) / 1e3);
		round_trip((u - 0.5) * pow(10, (double)(mr_random_bits(&r) % 30) - 12));
	}
	for (int i = 0; i < 50000; i++)
		round_trip(random_bits(&r));
}

static void
plain_text(void **state)
{
	static const struct {
		double x;
		const char *text;
	} cases[] = { { 0.1, "0.1" }, { -0.0, "-0" }, { 100, "100" }, { 1.5, "1.5" }, { 1e-3, "0.001" },
		{ 123456.789, "123456.789" }, { 0.30000000000000004, "0.30000000000000004" },
		{ 636110.300003, "636110.300003" }, { 1e-7, "1e-07" }, { 1.25e-7, "1.25e-07" } };
	char text[MR_REAL_MAX + 1];

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		*mr_real_write(text, cases[i].x) = 0;
		assert_string_equal(text, cases[i].text);
	}
	*mr_count_write(text, UINT64_MAX) = 0;
	assert_string_equal(text, "18446744073709551615");
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(known), cmocka_unit_test(not_numbers),
		cmocka_unit_test(ends), cmocka_unit_test(random_texts), cmocka_unit_test(halfway),
		cmocka_unit_test(written), cmocka_unit_test(plain_text) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}

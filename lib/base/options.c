/* Checks of options. */
#include "base/options.h"

mr_status
mr_check_number(mr_ctx *ctx, const char *name, double value, double least, double most)
{
	return value >= least && value <= most
	           ? MR_OK
	           : mr_fail(ctx, MR_EUSAGE, "%s is %g, where %g to %g can be", name, value, least, most);
}

mr_status
mr_check_choice(mr_ctx *ctx, const char *name, int choice, int last)
{
	return choice >= 0 && choice <= last
	           ? MR_OK
	           : mr_fail(ctx, MR_EUSAGE, "%s is %d, where 0 to %d can be", name, choice, last);
}

/* The options of a tool for people and for programs. */
#include "help.h"

void
cmd_help(const cmd *c, const cmd_opt *standard)
{
	const cmd_tool *tool = c->tool;

	printf("usage: %s [options] %s\n%s\n\n", c->name, tool->operands ? tool->operands : "[FILE...]",
	    tool->summary);
	cmd_print_options(stdout, tool->options);
	if (tool->options)
		putchar('\n');
	cmd_print_options(stdout, standard);
	printf("\nSee also: man %s, man 7 mr\n", c->name);
}

void
cmd_describe(cmd *c, const cmd_opt *standard)
{
	const cmd_tool *tool = c->tool;
	mr_text t = { .ctx = &c->ctx };
	const char *operands = tool->operands ? tool->operands : "[FILE...]";

	mr_text_add(&t, "{\"name\":\"%s\",\n \"summary\":", c->name);
	mr_text_json(&t, tool->summary, strlen(tool->summary));
	mr_text_add(&t, ",\n \"operands\":");
	mr_text_json(&t, operands, strlen(operands));
	mr_text_add(&t, ",\n \"options\":[");
	cmd_describe_options(&t, tool->options);
	mr_text_add(&t, "],\n \"common\":[");
	cmd_describe_options(&t, standard);
	mr_text_add(&t, "]}\n");
	fputs(t.s, stdout);
}

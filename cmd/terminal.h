/*
 * terminal.h -- whether a descriptor is a terminal, in front of which somebody sits.
 *
 * Layer rule: cmd; includes nothing.
 */
#ifndef TERMINAL_H
#define TERMINAL_H

#include <stdbool.h>

bool is_terminal(int fd);

#endif

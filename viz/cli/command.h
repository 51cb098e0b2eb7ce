/* SPDX-License-Identifier: MIT */
/* command.h - the commands of octreel: each is defined in the cmd_*.c of its name, and main.c has the table. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

/* argv[0] is the program's name; returns the exit status. */
int cmd_record(int argc, char **argv);
int cmd_play(int argc, char **argv);
int cmd_join(int argc, char **argv);
int cmd_verify(int argc, char **argv);
int cmd_audit(int argc, char **argv);
int cmd_pick(int argc, char **argv);
int cmd_inspect(int argc, char **argv);
int cmd_diff(int argc, char **argv);
int cmd_digest(int argc, char **argv);
int cmd_accept(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT */
/* choose.h - asks a person which findings to accept, one after the other, for octreel accept --interactive. */
#ifndef REPORT_CHOOSE_H
#define REPORT_CHOOSE_H

#include "accept.h"

/* An accept_chooser. The context is a choosing. For each finding it prints the sentence, the cause and the paths of the
 * pictures, and reads one line of answer. The end of the input is the answer q. */
typedef struct choosing {
    FILE *in, *out;
} choosing;

accept_chooser choose_findings;

#endif

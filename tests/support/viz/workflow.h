/* SPDX-License-Identifier: MIT */
/* workflow.h - the steps of a workflow or of an action of ours, run as GitHub's runner runs them: expressions are put
 * into the text of a step before a shell reads it, and each step has files for its outputs and its summary. */
#ifndef WORKFLOW_H
#define WORKFLOW_H

#include <jansson.h>

#include "temp_folder.h"

typedef struct workflow {
    const temp_folder *folder; /* where the steps run: `bin` in it comes first in PATH, `summary` is the page's text */
    const char *actions;       /* the folder of our own actions */
    json_t *values;            /* what expressions stand for: "inputs.frames" and a text */
    json_t *used;              /* the steps that use actions of others: {"uses": .., "with": {..}} */
    char *said;                /* all that steps wrote to stdout */
    char *complained;          /* and to stderr */
    /* Steps whose lines hold one of these words are left out; null ends them. */
    const char *const *left_out;
    unsigned steps; /* that ran */
} workflow;

void workflow_open(workflow *w, const temp_folder *folder, const char *actions);
void workflow_close(workflow *w);

/* What an expression stands for from here on. */
void workflow_set(workflow *w, const char *expression, const char *text);

/* Run the steps up to one that fails, and behind that those that ask for it. Returns the first status that is not 0. */
int workflow_run(workflow *w, const json_t *steps);

/* Run one of our actions with these inputs. Its outputs are values: "steps.ID.outputs.NAME". */
int workflow_run_action(workflow *w, const char *name, const json_t *inputs, const char *id);

/* A text with what its expressions stand for, as the runner makes it; the caller frees it. */
char *workflow_text(const workflow *w, const char *text);

#endif

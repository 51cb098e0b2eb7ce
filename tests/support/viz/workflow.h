/* SPDX-License-Identifier: MIT */
/* workflow.h - runs the steps of this project's GitHub workflows and actions as GitHub's runner does. run_steps.py does
 * the work; it needs Python's yaml (Debian: python3-yaml). */
#ifndef WORKFLOW_H
#define WORKFLOW_H

#include <jansson.h>

#include "temp_folder.h"

typedef struct workflow {
    const temp_folder
        *folder;         /* where the steps run: `bin` in it comes first in PATH, `summary` is the job's summary */
    const char *actions; /* the folder of this project's actions */
    json_t *values;      /* the value of each expression, by a name such as "inputs.frames" */
    json_t *used;        /* the steps that use actions of other projects: {"uses": .., "with": {..}} */
    char *out;           /* all text that steps wrote to stdout */
    char *err;           /* all text that steps wrote to stderr */
    unsigned steps;      /* number of steps that ran */
} workflow;

/* Exit with the status that ctest takes for skipped where Python's yaml is missing; call it first in main(). */
void skip_without_yaml(void);

/* The JSON form of a YAML text. Every scalar is a string. The caller releases it. */
json_t *yaml_read(const char *text);
json_t *yaml_read_file(const char *path);

void workflow_open(workflow *w, const temp_folder *folder, const char *actions);
void workflow_close(workflow *w);

/* Set the value of an expression. */
void workflow_set(workflow *w, const char *expression, const char *text);

/* Run the steps up to the first that fails, and after it those whose condition is failure() or always(). Returns the
 * status of the step that failed, or 0. */
int workflow_run(workflow *w, const json_t *steps);

/* Run one of this project's actions. Its outputs become values: "steps.ID.outputs.NAME". */
int workflow_run_action(workflow *w, const char *name, const json_t *inputs, const char *id);

#endif

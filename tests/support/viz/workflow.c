/* SPDX-License-Identifier: MIT */
#include "workflow.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

enum { SKIPPED = 77 /* SKIP_RETURN_CODE of the tests */ };

/* Run the script with a text as its stdin. The caller releases the JSON value that the script prints. */
static json_t *run_python(const char *option, const char *input)
{
    char path[] = "/tmp/octreel_steps_XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    file_write_text(path, input);
    command_result result =
        run_script("python3 %s %s <%s", shell_quote(OCTREEL_DRIVES "/run_steps.py").text, option, path);
    remove(path);
    if (result.status != 0)
        fail_msg("%s", result.err);
    json_t *value = json_loads(result.out, 0, NULL);
    assert_non_null(value);
    command_release(&result);
    return value;
}

void skip_without_yaml(void)
{
    if (system("python3 -c 'import yaml' 2>/dev/null") == 0)
        return;
    puts("skipped: Python's yaml is missing (Debian: python3-yaml)");
    exit(SKIPPED);
}

json_t *yaml_read(const char *text)
{
    return run_python("--parse", text);
}

json_t *yaml_read_file(const char *path)
{
    char *text = file_read(path, NULL);
    json_t *value = yaml_read(text);
    free(text);
    return value;
}

void workflow_open(workflow *w, const temp_folder *folder, const char *actions)
{
    *w = (workflow){.folder = folder, .actions = actions, .values = json_object(), .used = json_array()};
    w->out = calloc(1, 1);
    w->err = calloc(1, 1);
    assert_non_null(w->out);
    assert_non_null(w->err);
}

void workflow_close(workflow *w)
{
    json_decref(w->values);
    json_decref(w->used);
    free(w->out);
    free(w->err);
}

void workflow_set(workflow *w, const char *expression, const char *text)
{
    assert_int_equal(json_object_set_new(w->values, expression, json_string(text)), 0);
}

static void append_text(char **all, const json_t *more)
{
    *all = realloc(*all, strlen(*all) + json_string_length(more) + 1);
    assert_non_null(*all);
    strcat(*all, json_string_value(more));
}

/* Run what the request asks for; its reference is taken over. */
static int run_request(workflow *w, json_t *request)
{
    assert_non_null(request);
    json_object_set_new(request, "folder", json_string(w->folder->name));
    json_object_set_new(request, "actions", json_string(w->actions));
    json_object_set(request, "values", w->values);
    char *text = json_dumps(request, 0);
    json_decref(request);
    json_t *done = run_python("", text);
    free(text);
    append_text(&w->out, json_object_get(done, "out"));
    append_text(&w->err, json_object_get(done, "err"));
    json_array_extend(w->used, json_object_get(done, "used"));
    json_object_update(w->values, json_object_get(done, "values"));
    w->steps += (unsigned)json_integer_value(json_object_get(done, "steps"));
    const int status = (int)json_integer_value(json_object_get(done, "status"));
    json_decref(done);
    return status;
}

int workflow_run(workflow *w, const json_t *steps)
{
    return run_request(w, json_pack("{s:O}", "steps", steps));
}

int workflow_run_action(workflow *w, const char *name, const json_t *inputs, const char *id)
{
    return run_request(w, json_pack("{s:s, s:O, s:s}", "action", name, "inputs", inputs, "id", id));
}

/* SPDX-License-Identifier: MIT */
#include "workflow.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "yaml.h"

void workflow_open(workflow *w, const temp_folder *folder, const char *actions)
{
    *w = (workflow){.folder = folder, .actions = actions, .values = json_object(), .used = json_array()};
    w->said = calloc(1, 1);
    w->complained = calloc(1, 1);
    assert_non_null(w->said);
    assert_non_null(w->complained);
}

void workflow_close(workflow *w)
{
    json_decref(w->values);
    json_decref(w->used);
    free(w->said);
    free(w->complained);
}

void workflow_set(workflow *w, const char *expression, const char *text)
{
    assert_int_equal(json_object_set_new(w->values, expression, json_string(text)), 0);
}

static const char *text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text ? text : "";
}

/* ---- Expressions ---------------------------------------------------------------------------------------------- */

/* Of a step that has not run there are no outputs; anything else must be known. */
static const char *value_of(const workflow *w, const char *expression)
{
    const json_t *value = json_object_get(w->values, expression);
    if (value == NULL && strncmp(expression, "steps.", 6) != 0)
        fail_msg("the expression %s stands for nothing here", expression);
    return value ? json_string_value(value) : "";
}

char *workflow_text(const workflow *w, const char *text)
{
    char *made = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&made, &size);
    assert_non_null(to);
    for (const char *at = text;;) {
        const char *begin = strstr(at, "${{ "), *end = begin ? strstr(begin, " }}") : NULL;
        if (end == NULL) {
            fputs(at, to);
            break;
        }
        char *expression = strndup(begin + 4, (size_t)(end - begin - 4));
        assert_non_null(expression);
        fwrite(at, 1, (size_t)(begin - at), to);
        fputs(value_of(w, expression), to);
        free(expression);
        at = end + 3;
    }
    assert_int_equal(fclose(to), 0);
    return made;
}

/* Whether a step runs: `if` is failure(), always() or a comparison such as steps.x.outputs.y == '1'. */
static bool is_wanted(const workflow *w, const char *condition, bool failed)
{
    char left[128], right[128];
    if (*condition == 0)
        return !failed;
    if (strcmp(condition, "failure()") == 0)
        return failed;
    if (strcmp(condition, "always()") == 0)
        return true;
    if (sscanf(condition, "%127s == '%127[^']'", left, right) != 2)
        fail_msg("tests/support/viz/workflow.c does not know the condition %s", condition);
    return !failed && strcmp(value_of(w, left), right) == 0;
}

/* ---- A step --------------------------------------------------------------------------------------------------- */

static void append(char **all, const char *more)
{
    *all = realloc(*all, strlen(*all) + strlen(more) + 1);
    assert_non_null(*all);
    strcat(*all, more);
}

/* What a step wrote into its file of outputs. */
static void take_outputs(workflow *w, const char *id)
{
    const place file = place_in(w->folder, "output");
    if (!file_exists(file.path))
        return;
    char *outputs = file_read(file.path, NULL);
    for (char *save = NULL, *line = strtok_r(outputs, "\n", &save); line; line = strtok_r(NULL, "\n", &save)) {
        char *value = strchr(line, '='), name[256];
        if (value == NULL)
            fail_msg("a line of outputs without a value: %s", line);
        *value++ = 0;
        snprintf(name, sizeof name, "steps.%s.outputs.%s", id, line);
        workflow_set(w, name, value);
    }
    free(outputs);
    remove(file.path);
}

/* The variables of a step as words of a shell's line. */
static char *environment_of(const workflow *w, const json_t *step)
{
    char *made = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&made, &size);
    assert_non_null(to);
    const char *name;
    json_t *value;
    json_object_foreach(json_object_get(step, "env"), name, value)
    {
        char *text = workflow_text(w, json_string_value(value));
        fprintf(to, "%s=%s ", name, shell_quote(text).text);
        free(text);
    }
    assert_int_equal(fclose(to), 0);
    return made;
}

static int run_lines(workflow *w, const json_t *step, const char *action_path)
{
    char *lines = workflow_text(w, text_of(step, "run")), *environment = environment_of(w, step);
    file_write_text(place_in(w->folder, "step").path, lines);
    const shell_word action = shell_quote(action_path);
    command_result result = run_script(
        "cd %s && mkdir -p temp && PATH=\"$PWD/bin:$PATH\" RUNNER_TEMP=\"$PWD/temp\" GITHUB_OUTPUT=\"$PWD/output\" "
        "GITHUB_STEP_SUMMARY=\"$PWD/summary\" GITHUB_ACTION_PATH=%s %s sh -e step",
        w->folder->name, action.text, environment);
    append(&w->said, result.out);
    append(&w->complained, result.err);
    take_outputs(w, text_of(step, "id"));
    const int status = result.status;
    command_release(&result);
    free(environment);
    free(lines);
    w->steps++;
    return status;
}

/* What a step hands to an action, with what its expressions stand for. */
static json_t *inputs_of(const workflow *w, const json_t *step)
{
    json_t *inputs = json_object(), *value;
    const char *name;
    json_object_foreach(json_object_get(step, "with"), name, value)
    {
        char *text = workflow_text(w, json_string_value(value));
        json_object_set_new(inputs, name, json_string(text));
        free(text);
    }
    return inputs;
}

static int use_action(workflow *w, const json_t *step)
{
    static const char ours[] = "/.github/actions/";
    const char *uses = text_of(step, "uses"), *name = strstr(uses, ours);
    json_t *inputs = inputs_of(w, step);
    int status = 0;
    if (name) {
        char *end = strndup(name + sizeof ours - 1, strcspn(name + sizeof ours - 1, "@"));
        assert_non_null(end);
        status = workflow_run_action(w, end, inputs, text_of(step, "id"));
        free(end);
    } else {
        json_array_append_new(w->used, json_pack("{s:s, s:O}", "uses", uses, "with", inputs));
    }
    json_decref(inputs);
    return status;
}

static bool is_left_out(const workflow *w, const json_t *step)
{
    for (const char *const *word = w->left_out; word && *word; word++)
        if (strstr(text_of(step, "run"), *word))
            return true;
    return false;
}

static int run_steps(workflow *w, const json_t *steps, const char *action_path)
{
    int status = 0;
    size_t i;
    json_t *step;
    json_array_foreach(steps, i, step)
    {
        if (is_left_out(w, step) || !is_wanted(w, text_of(step, "if"), status != 0))
            continue;
        const int ended = json_object_get(step, "run") ? run_lines(w, step, action_path) : use_action(w, step);
        status = status ? status : ended;
    }
    return status;
}

int workflow_run(workflow *w, const json_t *steps)
{
    return run_steps(w, steps, "");
}

/* ---- Actions of ours ------------------------------------------------------------------------------------------ */

/* What the action sees: its own inputs, and none of the values around it. */
static json_t *values_of(const json_t *declared, const json_t *inputs)
{
    json_t *values = json_object(), *input;
    const char *name;
    json_object_foreach((json_t *)declared, name, input)
    {
        const json_t *given = json_object_get(inputs, name);
        if (given == NULL && strcmp(text_of(input, "required"), "true") == 0)
            fail_msg("the action's input %s is missing", name);
        char expression[128];
        snprintf(expression, sizeof expression, "inputs.%s", name);
        json_object_set_new(values, expression,
                            json_string(given ? json_string_value(given) : text_of(input, "default")));
    }
    json_object_foreach((json_t *)inputs, name, input) if (!json_object_get(declared, name))
        fail_msg("the action has no input %s", name);
    return values;
}

int workflow_run_action(workflow *w, const char *name, const json_t *inputs, const char *id)
{
    const place folder = place_below(w->actions, name);
    json_t *action = yaml_read_file(place_below(folder.path, "action.yml").path), *outer = w->values, *output;
    w->values = values_of(json_object_get(action, "inputs"), inputs);
    const int status = run_steps(w, json_object_get(json_object_get(action, "runs"), "steps"), folder.path);
    const char *key;
    json_object_foreach(json_object_get(action, "outputs"), key, output)
    {
        char *text = workflow_text(w, text_of(output, "value")), expression[256];
        snprintf(expression, sizeof expression, "steps.%s.outputs.%s", id, key);
        json_object_set_new(outer, expression, json_string(text));
        free(text);
    }
    json_decref(w->values);
    w->values = outer;
    json_decref(action);
    return status;
}

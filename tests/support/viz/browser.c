/* SPDX-License-Identifier: MIT */
/* browser.c - see browser.h. */
#include "browser.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "scripted_page.h"

/* Nothing is asked of a network, and nothing is kept. The sandbox needs more of the system than containers give. */
static const char options[] = "--headless --no-sandbox --disable-gpu --disable-extensions --no-first-run "
                              "--disable-background-networking --disable-component-update "
                              "--host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=10000000 --dump-dom";

bool is_browser_installed(void)
{
    return is_program_installed("chromium");
}

void skip_without_browser(void)
{
    if (is_browser_installed())
        return;
    print_message("chromium is not installed: the page is not opened\n");
    skip();
}

/* As an address has it. */
static void put_encoded(FILE *out, const char *text)
{
    for (const unsigned char *at = (const unsigned char *)text; *at; at++)
        if (isalnum(*at) || strchr("/-_.~", *at) != NULL)
            putc(*at, out);
        else
            fprintf(out, "%%%02X", (unsigned)*at);
}

char *browser_open(const temp_folder *own, const char *path, const char *hash)
{
    char current[1024], *line;
    size_t size;
    assert_non_null(getcwd(current, sizeof current));
    FILE *out = open_memstream(&line, &size);
    assert_non_null(out);
    fprintf(out, "exec chromium %s --user-data-dir='%s' 'file://", options, place_in(own, "browser").path);
    put_encoded(out, current);
    putc('/', out);
    put_encoded(out, path);
    fprintf(out, "#%s' </dev/null", hash);
    assert_int_equal(fclose(out), 0);
    command_result result = run_shell(line);
    free(line);
    if (result.status != 0)
        fail_msg("chromium ended with %d: %s", result.status, result.err);
    char *page = result.out;
    free(result.err);
    return page;
}

/* ---- Pages that a script uses -------------------------------------------------------------------------------- */

/* &amp; &lt; and &gt; in place. */
static void decode(char *text)
{
    static const struct {
        const char *name;
        char character;
    } names[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}};
    char *to = text;
    while (*text != '\0') {
        size_t length = 1;
        char character = *text;
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
            if (strncmp(text, names[i].name, strlen(names[i].name)) == 0) {
                length = strlen(names[i].name);
                character = names[i].character;
            }
        *to++ = character;
        text += length;
    }
    *to = '\0';
}

/* Write "driven.js" beside the page: all scripts, one after the other. They run when the page has unpacked and run its
 * own scripts. */
static void write_driving_script(const char *folder, const char *const scripts[])
{
    FILE *file = fopen(place_below(folder, "driven.js").path, "w");
    assert_non_null(file);
    /* While a timer is due the browser's clock goes on by its steps. Without one it would run to its end at once where
     * the page waits for what has no clock, as for a compiler or a file. The timer ends with the script: the page is
     * read when the clock has run to its end. */
    fputs(
        "const clock = setInterval(() => document.getElementById(\"said\") && clearInterval(clock), 1);\n(async () => "
        "{\n"
        "while (document.getElementById(\"scripts\") && typeof octreel === \"undefined\")\n"
        "    await new Promise(done => setTimeout(done, 1));\n",
        file);
    for (size_t i = 0; scripts[i] != NULL; i++) {
        char *text = file_read(scripts[i], NULL);
        fputs(text, file);
        free(text);
    }
    fputs("})();\n", file);
    assert_int_equal(fclose(file), 0);
}

/* Write "driven.html", which runs the scripts, beside the page. */
static place write_driven_page(const char *page, const char *const scripts[])
{
    place folder;
    const char *slash = strrchr(page, '/');
    snprintf(folder.path, sizeof folder.path, "%.*s.", slash == NULL ? 0 : (int)(slash + 1 - page), page);
    const place driven = place_below(folder.path, "driven.html");
    char *text = file_read(page, NULL);
    assert_true(write_scripted_page(driven.path, text, "driven.js"));
    free(text);
    write_driving_script(folder.path, scripts);
    return driven;
}

char *browser_drive(const temp_folder *own, const char *page, const char *script)
{
    const char *const scripts[] = {script, NULL};
    return browser_drive_all(own, page, scripts);
}

char *browser_drive_all(const temp_folder *own, const char *page, const char *const scripts[])
{
    static const char begin[] = "<pre id=\"said\">";
    const place driven = write_driven_page(page, scripts);
    char *text = browser_open(own, driven.path, ""), *said = strstr(text, begin);
    const size_t size = strlen(text);
    if (said == NULL)
        fail_msg("the script of the page did not finish: %s", text + (size < 400 ? 0 : size - 400));
    *strstr(said, "</pre>") = '\0';
    decode(said);
    const size_t length = strlen(said + sizeof begin - 1);
    char *lines = malloc(length + 2);
    assert_non_null(lines);
    lines[0] = '\n';
    memcpy(lines + 1, said + sizeof begin - 1, length + 1);
    free(text);
    return lines;
}

char *find_reported_value(const char *said, const char *what)
{
    char line[128];
    const int length = snprintf(line, sizeof line, "\n%s\t", what);
    const char *found = strstr(said, line);
    if (found == NULL)
        fail_msg("the page reported no value for %s", what);
    found += length;
    return strndup(found, strcspn(found, "\n"));
}

void assert_reported_value(const char *said, const char *what, const char *expected)
{
    char *value = find_reported_value(said, what);
    if (strcmp(value, expected) != 0)
        fail_msg("%s: \"%s\" and not \"%s\"", what, value, expected);
    free(value);
}

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

/* Nothing is asked of a network, and nothing is kept. The sandbox needs more of the system than containers give. */
static const char options[] = "--headless --no-sandbox --disable-gpu --disable-extensions --no-first-run "
                              "--disable-background-networking --disable-component-update "
                              "--host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=5000 --dump-dom";

bool browser_is_there(void)
{
    return program_is_there("chromium");
}

void need_browser(void)
{
    if (browser_is_there())
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

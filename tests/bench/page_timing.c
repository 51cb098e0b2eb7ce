/* SPDX-License-Identifier: MIT */
/* page_timing.c - see page_timing.h. */
#include "page_timing.h"
#include "file.h"
#include "scripted_page.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TIMED_OUT = 124, NOT_FOUND = 127 };

#define MOST_SECONDS "300"

typedef struct play {
    const char *browser;
    char page[PATH_MAX], profile[PATH_MAX + 32];
    char *why;
    size_t room;
} play;

static bool fail(play *p, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(p->why, p->room, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- The script --------------------------------------------------------------------------------------------- */

/* Write the timing script beside the page, in a function because the script waits for promises. */
static bool write_script(play *p, uint64_t frames, const char *script)
{
    char path[PATH_MAX];
    const size_t folder = (size_t)(strrchr(p->page, '/') + 1 - p->page);
    if (snprintf(path, sizeof path, "%.*stiming.js", (int)folder, p->page) >= (int)sizeof path)
        return fail(p, "%s: the path is too long", p->page);
    FILE *file = fopen(path, "wb");
    if (file)
        fprintf(
            file,
            "const FRAMES = %" PRIu64 ", SIZES = [[%d, %d], [%d, %d]];\n(async () => {\n"
            "while (typeof octreel === \"undefined\")\n    await new Promise(done => setTimeout(done, 1));\n%s})();\n",
            frames, page_sizes[0][0], page_sizes[0][1], page_sizes[1][0], page_sizes[1][1], script);
    return (file && fclose(file) == 0) || fail(p, "%s: %s", path, strerror(errno));
}

/* Read a text file, which ends with a zero in memory. The caller frees it. Null on failure. */
static char *read_text(play *p, const char *path, size_t *size)
{
    octreel_error error;
    char *text;
    if (!file_read_whole(path, &text, size, &error))
        return fail(p, "%s", error.text), NULL;
    text[*size] = 0;
    return text;
}

static bool add_script(play *p, uint64_t frames, page_times *times)
{
    size_t size = 0;
    char *script = read_text(p, PAGE_SCRIPT, &size), *page = script ? read_text(p, p->page, &size) : NULL;
    times->kb = (double)size / 1000;
    const bool ok = page && write_script(p, frames, script) &&
                    (write_scripted_page(p->page, page, "timing.js") || fail(p, "%s: %s", p->page, strerror(errno)));
    free(page);
    free(script);
    return ok;
}

/* ---- The browser -------------------------------------------------------------------------------------------- */

/* What the page says on the console becomes lines of the browser's standard error. Frames follow each other as fast as
 * they are made, in a window that shows the picture at its size. timeout(1) ends the browser with all its processes. */
static pid_t start_browser(const play *p, int said)
{
    const pid_t child = fork();
    if (child != 0)
        return child;
    if (dup2(said, STDERR_FILENO) >= 0 && freopen("/dev/null", "r", stdin) && freopen("/dev/null", "w", stdout))
        execlp("timeout", "timeout", MOST_SECONDS, p->browser, "--headless", "--no-sandbox", "--disable-gpu",
               "--disable-dev-shm-usage", "--disable-extensions", "--no-first-run", "--disable-background-networking",
               "--disable-component-update", "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1920,1200",
               "--disable-frame-rate-limit", "--disable-gpu-vsync", "--enable-precise-memory-info",
               "--enable-logging=stderr", p->profile, p->page, (char *)NULL);
    _exit(NOT_FOUND);
}

/* Returns the rest of the line that the script prints. If the browser ends before, returns null, and `line` is the last
 * line that it printed. The caller frees `line`. */
static const char *hear(FILE *said, char **line)
{
    static const char sign[] = "octreel-bench: ";
    char *next = NULL;
    for (size_t room = 0; getline(&next, &room, said) > 0; next = NULL, room = 0) {
        free(*line);
        *line = next;
        const char *found = strstr(next, sign);
        if (found)
            return found + sizeof sign - 1;
    }
    free(next);
    return NULL;
}

static bool read_times(play *p, const char *told, page_times *times)
{
    static const char left_out[] = "left out: ";
    double bytes;
    if (strncmp(told, left_out, sizeof left_out - 1) == 0)
        return fail(p, "%.*s", (int)strcspn(told, "\"\n") - (int)sizeof left_out + 1, told + sizeof left_out - 1);
    page_turning *small = &times->turning[0], *large = &times->turning[1];
    if (sscanf(told, "first %lf frame %lf draw %lf scrub %lf turn %lf %lf %lf %lf %lf %lf bytes %lf", &times->first_ms,
               &times->frame_ms, &times->draw_ms, &times->scrub_ms, &small->full_ms, &small->ms, &small->scale,
               &large->full_ms, &large->ms, &large->scale, &bytes) != 11)
        return fail(p, "it says \"%.100s\"", told);
    times->mib = bytes / (1 << 20);
    return true;
}

/* The browser may write into its folder until it has ended. */
static int end_browser(pid_t browser, FILE *said)
{
    int status = -1;
    kill(browser, SIGTERM);
    while (getc(said) != EOF)
        continue;
    while (waitpid(browser, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* State why the browser printed no times: timeout(1) ends with 124 if it stopped the browser. */
static void fail_without_times(play *p, int status, const char *last)
{
    if (status == NOT_FOUND)
        fail(p, "there is no %s", p->browser);
    else if (status == TIMED_OUT)
        fail(p, "%s needed more than %s s", p->browser, MOST_SECONDS);
    else
        fail(p, "%s ended with status %d before the page had played; its last words: %.*s", p->browser, status,
             last ? (int)strcspn(last, "\n") : 4, last ? last : "none");
}

static bool run_browser(play *p, page_times *times)
{
    int ends[2];
    char *line = NULL;
    if (pipe(ends) != 0)
        return fail(p, "%s", strerror(errno));
    const pid_t browser = start_browser(p, ends[1]);
    close(ends[1]);
    FILE *said = browser > 0 ? fdopen(ends[0], "r") : NULL;
    if (!said)
        return close(ends[0]), fail(p, "%s", strerror(errno));
    const char *told = hear(said, &line);
    const bool ok = told && read_times(p, told, times);
    const int status = end_browser(browser, said);
    fclose(said);
    if (!told)
        fail_without_times(p, status, line);
    free(line);
    return ok;
}

/* The browser takes paths from anywhere, and one from the root cannot be an option. */
static bool find_page(play *p, const char *folder)
{
    char current[PATH_MAX] = "";
    if (folder[0] != '/' && !getcwd(current, sizeof current))
        return fail(p, "%s", strerror(errno));
    const char *between = folder[0] == '/' ? "" : "/";
    const int profile =
        snprintf(p->profile, sizeof p->profile, "--user-data-dir=%s%s%s/browser", current, between, folder);
    const int page = snprintf(p->page, sizeof p->page, "%s%s%s/index.html", current, between, folder);
    return (profile < (int)sizeof p->profile && page < (int)sizeof p->page) || fail(p, "%s", strerror(ENAMETOOLONG));
}

bool page_time(const char *browser, const char *folder, uint64_t frames, page_times *times, char *why, size_t room)
{
    play p = {.browser = browser, .why = why, .room = room};
    return find_page(&p, folder) && add_script(&p, frames, times) && run_browser(&p, times);
}

/* SPDX-License-Identifier: MIT */
/* ffmpeg.c - runs ffmpeg as a child that reads raw frames from a pipe. */
#include "ffmpeg.h"
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

struct ffmpeg {
    file_writer file; /* ffmpeg writes the temporary file of this writer; the writer's stream is not used */
    FILE *frames;     /* the pipe that ffmpeg reads */
    pid_t child;
    void (*old_handler)(int signal); /* the handler of SIGPIPE */
};

const char *ffmpeg_find_format(const char *path)
{
    return file_has_ending(path, ".mp4") ? "mp4" : file_has_ending(path, ".webm") ? "webm" : NULL;
}

/* Start the child. The child has a process group of its own, so that Ctrl-C interrupts only this process, not ffmpeg.
 * Returns 0, or the reason of a failure as a value of errno. */
static int start_child(ffmpeg *f, char *const *arguments, int input)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t pipe_signal;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
    int reason = posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    if (reason == 0)
        reason = posix_spawnp(&f->child, arguments[0], &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return reason;
}

/* Start ffmpeg with a pipe for the frames. Most players need yuv420p, which needs an even width and height. "file:"
 * keeps ffmpeg from reading a name such as "a:b" as a protocol. Returns 0, or the reason of a failure as a value of
 * errno. */
static int start_ffmpeg(ffmpeg *f, int width, int height, unsigned rate)
{
    char size[32], speed[16], output[PATH_MAX + 8];
    int ends[2];
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(speed, sizeof speed, "%u", rate);
    snprintf(output, sizeof output, "file:%s", f->file.temp);
    const char *const arguments[] = {"ffmpeg",
                                     "-v",
                                     "error",
                                     "-f",
                                     "rawvideo",
                                     "-pix_fmt",
                                     "rgb24",
                                     "-s",
                                     size,
                                     "-r",
                                     speed,
                                     "-i",
                                     "pipe:0",
                                     "-vf",
                                     "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                     "-pix_fmt",
                                     "yuv420p",
                                     "-f",
                                     ffmpeg_find_format(f->file.path),
                                     "-y",
                                     output,
                                     NULL};
    if (pipe(ends) != 0)
        return errno;
    /* The child must not inherit the write end: while the child held it open, the pipe would never end, and ffmpeg
     * would wait for more frames for ever. */
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    const int reason = start_child(f, (char *const *)arguments, ends[0]);
    close(ends[0]);
    f->frames = reason == 0 ? fdopen(ends[1], "wb") : NULL;
    if (!f->frames)
        close(ends[1]);
    return reason != 0 || f->frames ? reason : ENOMEM;
}

static bool open_output_file(ffmpeg *f, const char *path, octreel_error *error)
{
    if (!file_writer_open(&f->file, path, error))
        return false;
    if (f->file.temp && strcmp(f->file.temp, path) != 0)
        return true;
    file_writer_discard(&f->file);
    return error_set(error, "%s: ffmpeg can write a video only to a regular file", file_output_display_name(path));
}

ffmpeg *ffmpeg_open(const char *path, int width, int height, unsigned rate, octreel_error *error)
{
    ffmpeg *f = calloc(1, sizeof *f);
    if (!f || !open_output_file(f, path, error)) {
        if (!f)
            error_no_memory(error);
        free(f);
        return NULL;
    }
    f->old_handler = signal(SIGPIPE, SIG_IGN);
    const int reason = start_ffmpeg(f, width, height, rate);
    if (reason == 0)
        return f;
    if (reason == ENOENT)
        error_set(error,
                  "%s: cannot be written, because the program ffmpeg is not installed; install the package ffmpeg, or "
                  "name a file that ends with .png",
                  path);
    else
        error_set(error, "%s: cannot be written: ffmpeg cannot be started: %s", path, strerror(reason));
    ffmpeg_discard(f);
    return NULL;
}

bool ffmpeg_add(ffmpeg *f, const uint8_t *rgb, size_t size, octreel_error *error)
{
    return fwrite(rgb, 1, size, f->frames) == size ||
           error_set(error, "%s: cannot be written: ffmpeg ended early", f->file.path);
}

/* Close the pipe and wait for the child. Returns whether ffmpeg succeeded. */
static bool close_pipe_and_wait(ffmpeg *f)
{
    int status = -1;
    const bool sent = f->frames && fclose(f->frames) == 0;
    while (f->child > 0 && waitpid(f->child, &status, 0) < 0 && errno == EINTR)
        continue;
    signal(SIGPIPE, f->old_handler);
    return sent && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool ffmpeg_close(ffmpeg *f, octreel_error *error)
{
    const bool whole = close_pipe_and_wait(f),
               ok = whole ? file_writer_close(&f->file, error) : file_writer_discard(&f->file);
    if (!whole)
        error_set(error, "%s: cannot be written: ffmpeg failed", f->file.path);
    free(f);
    return ok;
}

void ffmpeg_discard(ffmpeg *f)
{
    if (f->child > 0)
        kill(f->child, SIGKILL);
    close_pipe_and_wait(f);
    file_writer_discard(&f->file);
    free(f);
}

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays GitHub's gh for tests of the action. It knows the calls that the action makes; any other call fails.

The folder `server` beside the folder of this program holds the state:
    calls        one line for each call: its arguments as JSON
    comments.json  the comments of the pull request, as `gh pr view --json comments` prints them
    no-attach    if this file exists, gh is older than 2.99
    token-refused  ... the token can comment, but not attach pictures
    read-only    ... the token can only read
    down         ... nothing can be reached
    partial      ... a picture cannot be attached: gh posts the comment and fails
"""
import json
import os
import re
import shutil
import subprocess
import sys

server = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(sys.argv[0]))), "server")
path = os.path.join(server, "comments.json")


def has(name):
    return os.path.exists(os.path.join(server, name))


def fail(text):
    sys.exit(text)


def read_comments():
    with open(path) as file:
        return json.load(file)


def write_comments(comments):
    with open(path, "w") as file:
        json.dump(comments, file)


def url_of(number):
    return f"https://github.test/o/r/pull/5#issuecomment-{number}"


def view(arguments):
    """Without jq the marker in the query decides."""
    if arguments[:5] != ["5", "--repo", "o/r", "--json", "comments"] or arguments[5] != "--jq":
        fail(f"unknown arguments: {arguments}")
    comments, query = read_comments(), arguments[6]
    if shutil.which("jq"):
        done = subprocess.run(["jq", "-r", query], input=json.dumps({"comments": comments}), text=True, check=True,
                              capture_output=True)
        print(done.stdout, end="")
        return
    marker = re.search(r'startswith\("(.*?)"\)', query)[1]
    for comment in comments:
        if comment["viewerDidAuthor"] and comment["body"].startswith(marker):
            print(comment["url"].split("-")[-1])


def post(arguments):
    if arguments == ["--help"]:
        print("FLAGS\n" + ("" if has("no-attach") else "      --attach file   Attach an image\n") + "  -b, --body text")
        return
    if arguments[:4] != ["5", "--repo", "o/r", "--body-file"] or any(a != "--attach" for a in arguments[5::2]):
        fail(f"unknown arguments: {arguments}")
    pictures = arguments[6::2]
    if pictures and has("no-attach"):
        fail("unknown flag: --attach")
    if pictures and has("token-refused"):
        fail("unsupported authentication type")
    if has("read-only"):
        fail("GraphQL: Resource not accessible by integration (addComment)")
    with open(arguments[4]) as file:
        body = file.read()
    for picture in pictures:
        with open(picture, "rb") as file:
            if file.read(4) != b"\x89PNG":
                fail(f"{picture}: not a picture")
        body = body.replace(f"]({picture})", f"](https://github.test/attached/{picture[2:]})")
    comments = read_comments()
    number = 100 + sum(len(line) > 0 for line in open(os.path.join(server, "calls")))
    comments.append({"url": url_of(number), "body": body, "viewerDidAuthor": True})
    write_comments(comments)
    print(url_of(number))
    if pictures and has("partial"):
        fail("1.actual.png: upload failed")


def edit(arguments):
    if arguments[0] != "--method" or arguments[3] != "--silent":
        fail(f"unknown arguments: {arguments}")
    method, number = arguments[1], re.fullmatch(r"repos/o/r/issues/comments/(\d+)", arguments[2])[1]
    if has("read-only"):
        fail("gh: Resource not accessible by integration (HTTP 403)")
    comments = read_comments()
    found = [comment for comment in comments if comment["url"] == url_of(number)]
    if len(found) != 1:
        fail("gh: Not Found (HTTP 404)")
    if method == "DELETE":
        comments.remove(found[0])
    elif method == "PATCH" and arguments[4] == "--field" and arguments[5].startswith("body=@"):
        with open(arguments[5][6:]) as file:
            found[0]["body"] = file.read()
    else:
        fail(f"unknown arguments: {arguments}")
    write_comments(comments)


with open(os.path.join(server, "calls"), "a") as calls:
    calls.write(json.dumps(sys.argv[1:]) + "\n")
if os.environ.get("GH_TOKEN") != "secret" or os.environ.get("GH_HOST") != "github.test":
    fail("gh: authentication needed")
if has("down"):
    fail("error connecting to github.test")
COMMANDS = {("pr", "view"): (view, 2), ("pr", "comment"): (post, 2), ("api", "--method"): (edit, 1)}
command, taken = COMMANDS.get(tuple(sys.argv[1:3]), (None, 0))
if command is None:
    fail(f"unknown command: {sys.argv[1:]}")
command(sys.argv[1 + taken:])

# SPDX-License-Identifier: MIT
"""Run the steps of a GitHub workflow or action as GitHub's runner does.

run_steps.py --parse: convert YAML on stdin to JSON on stdout. All scalars become strings.

run_steps.py: run the steps that a JSON object on stdin describes:
    steps    the steps of a job; or, in place of them,
    action   the name of an action, with its `inputs` and the `id` of the step that uses it
    values   the value of each expression, such as "inputs.frames"
    folder   where the steps run; its `bin` comes first in PATH, and `summary` in it gets the text of the job's summary
    actions  the folder of this project's actions
The JSON object on stdout has the status of the first step that failed (or 0), what the steps wrote (out and err), the
actions of other projects that they use (used), the number of steps that ran (steps), and the values afterwards.

The runner replaces expressions before a shell reads the lines, gives each step files for its outputs and its summary, and
after a failed step runs only steps with the condition failure() or always(). An expression or condition that is not known
here is an error.
"""
import json
import os
import re
import subprocess
import sys

import yaml


class Loader(yaml.BaseLoader):
    """Refuses a key that occurs twice in a mapping, as GitHub does."""

    def construct_mapping(self, node, deep=False):
        keys = [key.value for key, _ in node.value]
        if len(keys) != len(set(keys)):
            raise yaml.YAMLError(f"a key occurs twice: {keys}, {node.start_mark}")
        return super().construct_mapping(node, deep)


class Runner:
    def __init__(self, request):
        self.folder = os.path.abspath(request["folder"])
        self.actions = request["actions"]
        self.values = request["values"]
        self.out = self.err = ""
        self.used = []
        self.steps = 0

    def value(self, expression):
        """A step that has not run has empty outputs, and an event has no members but those that a test sets."""
        if expression == "runner.temp":
            return os.path.join(self.folder, "temp")
        if expression not in self.values and not expression.startswith(("steps.", "github.")):
            sys.exit(f"the expression {expression} has no value")
        return self.values.get(expression, "")

    def replace_expressions(self, text):
        return re.sub(r"\$\{\{ (.*?) \}\}", lambda match: self.value(match[1]), text)

    def replace_in_members(self, members):
        return {name: self.replace_expressions(text) for name, text in members.items()}

    def is_due(self, condition, failed):
        if condition in ("failure()", "always()"):
            return failed or condition == "always()"
        if not condition:
            return not failed
        comparison = re.fullmatch(r"(\S+) == '([^']*)'", condition)
        if not comparison:
            sys.exit(f"run_steps.py does not know the condition {condition}")
        return not failed and self.value(comparison[1]) == comparison[2]

    def run_lines(self, step, action_path):
        files = {name: os.path.join(self.folder, name) for name in ("bin", "output", "step", "summary", "temp")}
        os.makedirs(files["temp"], exist_ok=True)
        with open(files["step"], "w") as file:
            file.write(self.replace_expressions(step["run"]))
        environment = dict(os.environ, GITHUB_SERVER_URL="https://github.test", GITHUB_REPOSITORY="o/r", GITHUB_RUN_ID="7",
                           PATH=files["bin"] + ":" + os.environ["PATH"], RUNNER_TEMP=files["temp"],
                           GITHUB_OUTPUT=files["output"], GITHUB_STEP_SUMMARY=files["summary"],
                           GITHUB_ACTION_PATH=action_path, **self.replace_in_members(step.get("env", {})))
        done = subprocess.run(["sh", "-e", "step"], cwd=self.folder, env=environment, capture_output=True)
        self.out += done.stdout.decode(errors="replace")
        self.err += done.stderr.decode(errors="replace")
        self.steps += 1
        if os.path.exists(files["output"]):
            with open(files["output"]) as file:
                for line in file.read().splitlines():
                    name, value = line.split("=", 1)
                    self.values[f"steps.{step.get('id', '')}.outputs.{name}"] = value
            os.remove(files["output"])
        return done.returncode

    def use_action(self, step):
        inputs = self.replace_in_members(step.get("with", {}))
        own = re.search(r"/\.github/actions/([^@]*)", step["uses"])
        if own:
            return self.run_action(own[1], inputs, step.get("id", ""))
        self.used.append({"uses": step["uses"], "with": inputs})
        if step["uses"].startswith("actions/upload-artifact@"):
            self.values[f"steps.{step.get('id', '')}.outputs.artifact-url"] = "https://github.test/artifact"
        return 0

    def run_steps(self, steps, action_path=""):
        status = 0
        for step in steps:
            if self.is_due(step.get("if", ""), status != 0):
                ended = self.run_lines(step, action_path) if "run" in step else self.use_action(step)
                status = status or ended
        return status

    def run_action(self, name, inputs, step_id):
        """An action knows its own inputs and the values of the run. Its outputs are values of the step that uses it."""
        path = os.path.join(self.actions, name)
        with open(os.path.join(path, "action.yml")) as file:
            action = yaml.load(file, Loader)
        declared, outer = action.get("inputs", {}), self.values
        for unknown in inputs.keys() - declared.keys():
            sys.exit(f"the action has no input {unknown}")
        self.values = {name: value for name, value in outer.items() if name.startswith("github.")}
        for key, declaration in declared.items():
            if key not in inputs and declaration.get("required") == "true":
                sys.exit(f"the action's input {key} is missing")
            self.values["inputs." + key] = inputs.get(key) if key in inputs else self.replace_expressions(
                declaration.get("default", ""))
        status = self.run_steps(action["runs"]["steps"], path)
        for key, output in action.get("outputs", {}).items():
            outer[f"steps.{step_id}.outputs.{key}"] = self.replace_expressions(output["value"])
        self.values = outer
        return status


def main():
    if sys.argv[1:] == ["--parse"]:
        json.dump(yaml.load(sys.stdin, Loader), sys.stdout)
        return
    request = json.load(sys.stdin)
    runner = Runner(request)
    if "action" in request:
        status = runner.run_action(request["action"], request["inputs"], request["id"])
    else:
        status = runner.run_steps(request["steps"])
    json.dump({"status": status, "out": runner.out, "err": runner.err, "used": runner.used, "steps": runner.steps,
               "values": runner.values}, sys.stdout)


main()

#!/usr/bin/python3
"""Runs the steps of the workflows' Linux jobs as GitHub runs them, and prints "ok ..." or "FAILED ..." of each.

A container begins without git, make and others, and its folder belongs to another user. actions/checkout uses git if the
container has it; otherwise it unpacks an archive, which lacks what .gitattributes leaves out:
https://github.com/actions/checkout/blob/v4/src/git-source-provider.ts. The folder `build` is that of the other steps, so that
little is compiled; STEPS shortens `make test` and `make test-all`. Stand-ins: apt-get, curl, gh, pipx. What dist.sh says of the
files that a release offers is printed as well.
BUILD: an absolute folder for what is built.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("BUILD", ROOT / "build/test"))
WORK = BUILD / "workflows"
ABSENT = ("git", "make", "python3", "unzip", "chromium", "lintian")  # no image of Debian or Ubuntu has these
TOOLS, CONTAINER, REPOSITORY, ARTIFACTS = (WORK / name for name in ("tools", "container", "repository", "artifacts"))

# Installs by linking: what else is missing here stays missing.
APT_GET = """#!/bin/sh
for package; do
  case " {absent} " in *" $package "*) ln -sf "$(PATH='{path}' command -v "$package")" "$INSTALLED/$package" ;; esac
done
"""
DPKG_QUERY = """#!/bin/sh
for package; do :; done
case " {absent} " in *" $package "*) [ -e "$INSTALLED/$package" ] || exit 1 ;; esac
exec {dpkg_query} "$@"
"""
RECORD = """#!/bin/sh
echo "${0##*/} $*" >>"$CALLS"
case "$*" in *--notes-file*) cp notes.md "$CALLS.notes" ;; esac
"""


def script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def run(*command, **options):
    return subprocess.run(command, check=True, **options)


def prepare():
    """Makes a repository of this folder, and the commands that a container has."""
    shutil.rmtree(WORK, ignore_errors=True)
    for folder in (TOOLS, CONTAINER, REPOSITORY, ARTIFACTS):
        folder.mkdir(parents=True)
    tar = subprocess.Popen(["tar", "cf", "-", "--exclude=./build", "--exclude=./dist", "--exclude=./.git", "."], cwd=ROOT, stdout=subprocess.PIPE)
    run("tar", "xof", "-", "-C", REPOSITORY, stdin=tar.stdout)
    for command in (["init", "-q"], ["add", "-A"], ["-c", "user.name=Test", "-c", "user.email=test@localhost", "commit", "-q", "-m", "Test"]):
        run("git", "-C", REPOSITORY, *command)
    run("make", "--no-print-directory", "-s", "-C", ROOT / "extras/scope", f"BUILD={BUILD}/scope")
    path = os.environ["PATH"]
    for folder in reversed(path.split(":")):
        for command in pathlib.Path(folder).glob("*"):
            link = CONTAINER / command.name
            if command.name not in ABSENT and os.access(command, os.X_OK):
                link.unlink(missing_ok=True)
                link.symlink_to(command)
    values = {"absent": " ".join(ABSENT), "path": path, "dpkg_query": shutil.which("dpkg-query") or "false"}
    script(TOOLS / "apt-get", APT_GET.format(**values))
    script(TOOLS / "dpkg-query", DPKG_QUERY.format(**values))
    script(TOOLS / "sudo", '#!/bin/sh\nexec "$@"\n')
    for command in ("curl", "gh", "pipx"):
        script(TOOLS / command, RECORD)


def verdict(is_right, what):
    print("ok" if is_right else "FAILED", f"workflows: {what}", flush=True)


class Job:
    def __init__(self, name, job):
        self.name = name
        self.is_container = "container" in job
        self.tree = WORK / name.replace(" ", "-")
        home = WORK / "homes" / self.tree.name
        self.installed = home / "bin"
        self.installed.mkdir(parents=True)
        self.tree.mkdir()
        (self.tree / "build").symlink_to(BUILD)
        path = f"{TOOLS}:{self.installed}:{CONTAINER}" if self.is_container else f"{TOOLS}:{os.environ['PATH']}"
        version = re.search("^version=(.*)", (ROOT / "library.properties").read_text(), re.M)[1]
        self.log = home / "log"
        self.log.touch()
        self.environment = {
            "HOME": str(home), "PATH": path, "INSTALLED": str(self.installed), "CALLS": str(WORK / "calls"),
            "GIT_CONFIG_SYSTEM": "/dev/null", "GITHUB_REF_NAME": f"v{version}", "GITHUB_REPOSITORY": "somebody/DecodeSBus",
            "GITHUB_REPOSITORY_OWNER": "somebody", "GITHUB_OUTPUT": str(home / "output"), "STEPS": "uses|package", "STEP_LOGS": str(home / "logs"),
            **{key: value for key, value in os.environ.items() if re.match("npm_|NODE_|https?_proxy|no_proxy|LANG|TERM|TMPDIR", key, re.I)}}

    def checkout(self):
        if self.is_container and not (self.installed / "git").exists():
            archive = subprocess.Popen(["git", "-C", REPOSITORY, "archive", "HEAD"], stdout=subprocess.PIPE)
            run("tar", "xf", "-", "-C", self.tree, stdin=archive.stdout)
        else:
            run("git", "clone", "-q", REPOSITORY, self.tree / "clone")
            for file in (self.tree / "clone").iterdir():
                file.rename(self.tree / file.name)
        # What has not changed since it was compiled is not compiled again.
        for folder, _, files in os.walk(self.tree):
            for file in files:
                here = pathlib.Path(folder, file)
                there = ROOT / here.relative_to(self.tree)
                if there.is_file() and not here.is_symlink():
                    shutil.copystat(there, here)
        if not self.is_container:
            return
        if os.geteuid() == 0:
            run("chown", "-hR", "1001:1001", self.tree)
        else:
            self.environment["GIT_TEST_ASSUME_DIFFERENT_OWNER"] = "1"  # as git's own tests do

    def use(self, action, settings):
        if action == "actions/checkout":
            self.checkout()
        elif action == "actions/upload-artifact":
            files = list(self.tree.glob(settings["path"].rstrip("/") + ("/*" if settings["path"].endswith("/") else "")))
            assert files, f"no file is like {settings['path']}"
            (ARTIFACTS / settings["name"]).mkdir(exist_ok=True)
            for file in files:
                if file.is_file():
                    shutil.copy(file, ARTIFACTS / settings["name"])
        elif action == "actions/download-artifact":
            shutil.copytree(ARTIFACTS / settings["name"], self.tree / settings["path"], dirs_exist_ok=True)
        elif action == "actions/upload-pages-artifact":
            assert any((self.tree / settings["path"]).iterdir())

    def step(self, step):
        """Runs a step, and returns whether it failed."""
        title = step.get("name") or (step["run"].strip().splitlines()[0] if "run" in step else step["uses"].split("@")[0])
        try:
            if "run" in step:
                shell = ["sh", "-e", "-c"] if self.is_container else ["bash", "-e", "-c"]
                with open(self.log, "wb") as log:
                    run(*shell, step["run"], cwd=self.tree, env={**self.environment, **step.get("env", {})}, stdin=subprocess.DEVNULL,
                        stdout=log, stderr=log, timeout=1800)
            else:
                self.use(step["uses"].split("@")[0], step.get("with", {}))
        except (subprocess.SubprocessError, OSError, AssertionError) as error:
            if step.get("continue-on-error"):
                return False
            print("".join(f"  {line}\n" for line in self.log.read_text(errors="replace").splitlines()[-30:]), error)
            verdict(False, f"{self.name}: {title}")
            return True
        if "run" in step:
            verdict(True, f"{self.name}: {title}")
            print("".join(re.findall("^(?:ok|skipped) dist: .*\n", self.log.read_text(errors="replace"), re.M)), end="", flush=True)
        return False

    def run(self, steps):
        """Runs the steps until one fails."""
        return not any(self.step(step) for step in steps)


def check_release():
    """Checks what the release's jobs have given to the stand-ins."""
    calls = (WORK / "calls").read_text()
    created = re.search(r"^gh release create v[0-9.]+ .*", calls, re.M)
    verdict(created and all(f" dist/{name}" in created[0] for name in ("DecodeSBus-", "scope.html", "sbus_", "sbus-", "SHA256SUMS")),
            "the release has the ZIP, the page, sbus twice and SHA256SUMS")
    notes = (WORK / "calls.notes").read_text() if created else ""
    verdict(notes.strip() and not re.search("^ |.\n[^-#\n]", notes, re.M), "its notes have no paragraph on more than one line")
    verdict("pipx run platformio pkg publish" in calls and "compote component upload --namespace somebody --name decodesbus" in calls,
            "the registries of PlatformIO and ESP-IDF get the library")


def main():
    print("\nworkflows: their jobs' own steps, each job in a fresh folder", flush=True)
    os.environ["GIT_CONFIG_GLOBAL"] = os.environ["GIT_CONFIG_SYSTEM"] = "/dev/null"
    for name in ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "MAKEFLAGS", "MAKELEVEL"):
        os.environ.pop(name, None)
    prepare()
    only = sys.argv[1:]
    for file in ("test.yml", "lint.yml", "release.yml"):
        for name, job in yaml.safe_load((ROOT / ".github/workflows" / file).read_text())["jobs"].items():
            if job.get("runs-on") == "ubuntu-latest" and any("run" in step for step in job["steps"]) and (not only or name in only):
                if name == "docs" and subprocess.check_output(["doxygen", "--version"], text=True).split()[0] != "1.9.4":
                    print("skipped workflows: docs: the warnings of this Doxygen are others")
                    continue
                Job(f"{file} {name}", job).run(job["steps"])
    if not only:
        check_release()


main()

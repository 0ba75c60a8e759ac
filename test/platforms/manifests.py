#!/usr/bin/python3
"""Compares library.json, idf_component.yml and zephyr/module.yml with each other and with the files that they name. Says
"ok ..." or "FAILED ...". Writes what it was told of the module to OUT/module, and the files that a component of ESP-IDF's
registry has to OUT/component. (Their form is checked by those who read them, when a release is published.)
    manifests.py OUT    from the repository's root
"""
import fnmatch
import json
import os
import pathlib
import re
import sys

import yaml  # as all three read theirs


def verdict(what, found):
    found = list(found)
    for error in found:
        print("  " + error)
    print(("FAILED" if found else "ok") + " platforms: " + what)


def component_files(root, files):
    """Filters as file_tools.py's filtered_paths() does: all, without those to exclude, and then those to include."""
    # os.walk() and not glob(): what other tests build may vanish meanwhile.
    paths = [os.path.relpath(os.path.join(folder, name), root) for folder, _, names in os.walk(root) for name in names]

    def named(patterns):
        return {path for path in paths if any(fnmatch.fnmatch(path, pattern) for pattern in patterns)}
    return set(paths) - named(files.get("exclude", [])) | named(files.get("include", []))


def main(out):
    root = pathlib.Path(".")
    properties = dict(line.split("=", 1) for line in (root / "library.properties").read_text().splitlines())
    library = json.loads((root / "library.json").read_text())
    component = yaml.safe_load((root / "idf_component.yml").read_text())
    module = yaml.safe_load((root / "zephyr/module.yml").read_text())

    versions = {properties["version"], library["version"], component["version"]}
    verdict("one version", [] if len(versions) == 1 else [str(versions)])
    addresses = {properties["url"], library["homepage"], library["repository"]["url"], component["url"], component["repository"]}
    verdict("one address", [] if len(addresses) == 1 else [str(addresses)])
    names = sorted(key.split("/")[-1] for key in library["dependencies"])
    verdict("Arduino and PlatformIO are told the same dependencies",
            [] if names == sorted(properties["depends"].split(",")) else [f"{names}, and depends={properties['depends']}"])
    verdict("the headers of library.json and library.properties are there",
            [name for name in library["headers"] + properties["includes"].split(",") if not (root / "src" / name).is_file()])

    files = component_files(root, component.get("files", {}))
    core = {str(path) for path in root.glob("src/sbus*/*")}
    rest = {"CMakeLists.txt", "CHANGELOG.md", "LICENSE", "README.md"}
    verdict("a component has the core and no more", sorted(files ^ (core | rest)))
    # scripts/zephyr_module.py of commit 013c135, process_cmake() and process_kconfig()
    folder, kconfig = root / module["build"]["cmake"], root / module["build"]["kconfig"]
    verdict("what zephyr/module.yml names is there",
            [str(path) for path in (folder / "CMakeLists.txt", kconfig) if not path.is_file()])
    defined = set(re.findall(r"^config (\w+)$", kconfig.read_text(), re.M))
    asked = set(re.findall(r"\bCONFIG_(\w+)", (folder / "CMakeLists.txt").read_text()))
    verdict("zephyr/Kconfig has what zephyr/CMakeLists.txt asks for", sorted(defined ^ asked))

    (out / "component").write_text("".join(f"{name}\n" for name in sorted(files)))
    (out / "module").write_text(f"{folder.resolve()}\n{' '.join(sorted(defined))}\n")


main(pathlib.Path(sys.argv[1]))

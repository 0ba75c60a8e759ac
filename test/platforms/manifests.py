#!/usr/bin/python3
"""Compares library.json, idf_component.yml and zephyr/module.yml with the rules of the programs that read them, and with each
other. Says "ok ..." or "FAILED ...". Writes what it was told of the module to OUT/module, and the files that a component of
ESP-IDF's registry has to OUT/component.
    manifests.py OUT    from the repository's root
"""
import json
import pathlib
import re
import sys

import yaml  # as all three read theirs

URL = r"https?://[^\s/.]+(\.[^\s/.]+)+(:\d+)?(/\S*)?"
ANY = r"(?s).+"


def limited(longest, pattern=ANY):
    return lambda value: isinstance(value, str) and len(value) <= longest and re.fullmatch(pattern, value) is not None


# A rule is a type, a function, [the rule of all], or {key: rule}; a key with ! is required. The readers ignore a key that they
# do not know, so here it is an error.
WORD = limited(50, r"[a-z\d_-]+|\*")
# platformio-core 145142e, platformio/package/manifest/schema.py:161. The owner is ours: without one any elapsedMillis will do.
LIBRARY = {
    "name!": limited(100, r"[^:;/,@<>]+"),
    "version!": limited(50, r"(0|[1-9]\d*)(\.(0|[1-9]\d*)){2}"),
    "description": limited(1000),
    "keywords": [limited(50, r"[a-z\d_+. -]+")],
    "authors": [{"name!": limited(100), "email": limited(50, r"\S+@\S+"), "maintainer": bool, "url": limited(255, URL)}],
    "homepage": limited(255, URL),
    "repository": {"type!": limited(3, "git|hg|svn"), "url!": limited(255), "branch": limited(50)},
    "license": limited(255, "MIT"),
    "frameworks": [WORD],
    "platforms": [WORD],
    "headers": [limited(255)],
    "dependencies": {r"[\w-]{1,100}/[^:;/,@<>]{1,100}": limited(100)},
    "export": {"include": [str], "exclude": [str]},
}
# idf-component-manager df79526, idf_component_tools/manifest/models.py:464, utils.py:92, constants.py:12
COMPONENT = {
    "version!": limited(50, r"\d+\.\d+\.\d+(~\d+)?(-[0-9a-zA-Z.-]+)?(\+[0-9a-zA-Z.-]+)?"),
    "targets": [str],
    "maintainers": [str],
    "description": str,
    "license": str,
    "tags": [limited(32, r"[A-Za-z0-9_-]{3,32}")],
    "dependencies": dict,
    "files": {"use_gitignore": bool, "include": [str], "exclude": [str]},
    "url": limited(2083, URL),
    "repository": limited(2083, r"(?i)(git|ssh|https?|git@[-\w.]+):(//)?(.*)(\.git)?(/?|#[-\d\w._]+?)"),
    "documentation": limited(2083, URL),
    "issues": limited(2083, URL),
}
# zephyr 3a39d0a, scripts/schemas/module-schema.yaml
ROOTS = ["board", "dts", "snippet", "soc", "arch", "module_ext", "sca"]
MODULE = {
    "name": str,
    "build": {
        "cmake": str,
        "kconfig": str,
        "cmake-ext": bool,
        "kconfig-ext": bool,
        "depends": [str],
        "settings": {root + "_root": str for root in ROOTS},
    },
    "tests": [str],
    "samples": [str],
    "boards": [str],
}


def errors(value, rule, where):
    """Yields the places at which the value breaks the rule."""
    if isinstance(rule, list):
        if not isinstance(value, list) or len(set(map(str, value))) < len(value):
            yield where + " is no list, or has something twice"
        else:
            for item in value:
                yield from errors(item, rule[0], f"{where}: {item}")
    elif isinstance(rule, dict):
        if not isinstance(value, dict):
            yield where + " is no mapping"
            return
        for key in [key[:-1] for key in rule if key.endswith("!")]:
            if key not in value:
                yield f"{where} lacks {key}"
        for key, item in value.items():
            known = [rule[name] for name in rule if re.fullmatch(name.rstrip("!"), key)]
            yield from errors(item, known[0], f"{where}: {key}") if known else [f"{where}: {key} is not known"]
    elif not (isinstance(value, rule) if isinstance(rule, type) else rule(value)):
        yield where


def verdict(what, found):
    found = list(found)
    for error in found:
        print("  " + error)
    print(("FAILED" if found else "ok") + " platforms: " + what)


def component_files(root, files):
    """Filters as file_tools.py's filtered_paths() does: all, without those to exclude, and then those to include."""
    paths = set(root.glob("**/*"))
    for pattern in files.get("exclude", []):
        paths -= set(root.glob(pattern))
    for pattern in files.get("include", []):
        paths |= set(root.glob(pattern))
    return {str(path.relative_to(root)) for path in paths if path.is_file()}


def main(out):
    root = pathlib.Path(".")
    properties = dict(line.split("=", 1) for line in (root / "library.properties").read_text().splitlines())
    library = json.loads((root / "library.json").read_text())
    component = yaml.safe_load((root / "idf_component.yml").read_text())
    module = yaml.safe_load((root / "zephyr/module.yml").read_text())

    verdict("library.json has PlatformIO's form", errors(library, LIBRARY, "library.json"))
    verdict("idf_component.yml has the component manager's form", errors(component, COMPONENT, "idf_component.yml"))
    verdict("zephyr/module.yml has Zephyr's form", errors(module, MODULE, "module.yml"))

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

#!/bin/sh
# Tags the release that HEAD is, and prints how to push it: v1.2.0 is the whole repository; 1.2.0 is a commit of the library
# alone, as .gitattributes has it. Arduino's Library Manager packs every file of a tag, .gitattributes or not. It goes through
# the tags that are not in a branch first, and takes the first of two tags that have one version.
set -eu
cd "$(dirname "$0")/../.."
version=$(sed -n 's/^version=//p' library.properties)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/library"
git archive HEAD | tar xf - -C "$work/library"
tree=$(
  GIT_DIR=$(git rev-parse --absolute-git-dir)
  export GIT_DIR GIT_WORK_TREE="$work/library" GIT_INDEX_FILE="$work/index"
  git add -Af && git write-tree
)
git tag -a -m "$version" "v$version"
git tag -a -m "$version, the library alone" "$version" "$(git commit-tree -p HEAD -m "$version, the library alone" "$tree")"
echo "git push --atomic origin HEAD v$version $version"

# The compilers' flags that more than one Makefile needs.

# For what we wrote. In tests, which set WERROR=1, a warning is an error; never in what a user builds: the next compiler has
# new ones.
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast $(if $(WERROR),-Werror)
# The board's core compiles everything with these.
BOARD := -std=gnu++11 -fno-exceptions -fno-rtti
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
# What each object is made of, noted beside it.
DEPENDENCIES = -MMD -MP -MT $@ -MF $@.d

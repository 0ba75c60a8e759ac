# The compilers' flags that more than one Makefile needs.

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast -Werror
# The board's core compiles everything with these.
BOARD := -std=gnu++11 -fno-exceptions -fno-rtti
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
# What each object is made of, noted beside it.
DEPENDENCIES = -MMD -MP -MT $@ -MF $@.d

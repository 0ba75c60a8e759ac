# Adds up doctest's summaries and the lines "ok ...", "FAILED ..." and "skipped ...". Fails if any failed, or if nothing ran.
#   [doctest] test cases:  7 |  6 passed | 1 failed | 0 skipped
/^\[doctest\] test cases:/ {
  split($0, part, "|")
  passed += part[2]
  failed += part[3]
}
/^ok / { passed++ }
/^skipped / { skipped++ }
/^FAILED / { failed++; failures = failures $0 "\n" }
END {
  printf "\n%s%d passed, %d failed%s\n", failures, passed, failed, (skipped > 0 ? ", " skipped " skipped" : "")
  exit failed > 0 || passed == 0
}

# Reads what doctest's -r=xml prints and says of each test case "assertions,failures,name". Fails if the end is missing,
# if nothing ran, if anything failed.
function attribute(name) {
  return match($0, name "=\"[^\"]*\"") ? substr($0, RSTART + length(name) + 2, RLENGTH - length(name) - 3) : ""
}
/^ *<TestCase / { name = attribute(" name") }
/^ *<OverallResultsAsserts .*test_case_success/ {
  print attribute("successes") "," attribute("failures") "," name
  ran++
  bad += attribute("test_case_success") != "true"
}
/^ *<OverallResultsTestCases / {
  ended = 1
  bad += attribute("failures") != 0
}
END { exit !ended || !ran || bad }

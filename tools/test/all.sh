#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every test: each package of src/ with `colcon test`, then those of tools/. Ends with 1 if
# any of them fails.
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
status=0

echo '== Packages of src/'
find build -path '*/pytest.xml' -delete 2>/dev/null
tools/in_environment --underlay colcon test --event-handlers console_cohesion- || status=1
tools/in_environment --underlay colcon test-result --verbose || status=1

echo '== tools/'
tools/in_environment python3 -m pytest tools || status=1

if [ "$status" -ne 0 ]; then
  echo 'Some tests failed: see above.' >&2
fi
exit "$status"

# SPDX-License-Identifier: Apache-2.0
"""Fixtures: nodes of a test with an executor and a ROS domain of their own, as in navigation2."""

from __future__ import annotations

import importlib.util
from pathlib import Path
import sys

sys.path[:0] = [str(Path(__file__).parent)]
_FILE = Path(__file__).parents[2] / 'navigation2' / 'test' / 'conftest.py'
_SPEC = importlib.util.spec_from_file_location('navigation2_fixtures', _FILE)
_MODULE = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(_MODULE)
domain, ros = _MODULE.domain, _MODULE.ros

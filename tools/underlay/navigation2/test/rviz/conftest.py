# SPDX-License-Identifier: Apache-2.0
"""What the tests of the page share can be imported."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))
sys.path.append(str(Path(__file__).parents[4] / 'test'))

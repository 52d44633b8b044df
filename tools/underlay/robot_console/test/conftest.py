# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share can be imported."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

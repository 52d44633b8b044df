# SPDX-License-Identifier: Apache-2.0
"""What tests of the console share."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

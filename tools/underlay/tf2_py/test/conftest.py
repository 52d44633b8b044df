# SPDX-License-Identifier: Apache-2.0
"""Let the test modules share what they need."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

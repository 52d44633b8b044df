# SPDX-License-Identifier: Apache-2.0
"""What several test modules share is found next to them."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

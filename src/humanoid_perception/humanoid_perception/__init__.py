# SPDX-License-Identifier: Apache-2.0
"""What the humanoid sees: objects in pictures, where they are, and what it remembers of them."""

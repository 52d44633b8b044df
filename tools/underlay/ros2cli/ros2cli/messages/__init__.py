# SPDX-License-Identifier: Apache-2.0
"""Messages as text and back."""

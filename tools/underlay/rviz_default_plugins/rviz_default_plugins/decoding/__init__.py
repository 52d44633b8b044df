# SPDX-License-Identifier: Apache-2.0
"""What messages hold, as arrays; nothing here knows the page."""

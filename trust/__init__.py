"""Campaigns that hunt for wrong answers and crashes, and the record of what they found."""

"""Benchmarks of alphamesh and its peers, measured in turn in one run.

Run ``python -m benchmarks --help`` from the root of the repository. The modules, in the
order in which they may import one another: ``clouds``, ``jobs``, ``machine``, ``results``,
``timing``, ``isolated``, ``plan``, ``tables``, ``plot``, ``verdict``, ``__main__``.
"""

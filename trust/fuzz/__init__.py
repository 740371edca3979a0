"""Coverage-guided fuzzing: of the core by libFuzzer, of the readers by atheris."""

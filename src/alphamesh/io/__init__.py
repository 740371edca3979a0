"""Files: clouds and masks in, meshes out. One small module per family of formats."""

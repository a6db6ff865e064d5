"""The command's part for museums: PTM files, lists of photographs, folders of relight."""

// The files of the typeface as read-only data.
    .section .rodata
    .global thermedge_typeface_regular
    .global thermedge_typeface_regular_end
    .global thermedge_typeface_semibold
    .global thermedge_typeface_semibold_end
    .balign 16
thermedge_typeface_regular:
    .incbin REGULAR_FILE
thermedge_typeface_regular_end:
    .balign 16
thermedge_typeface_semibold:
    .incbin SEMIBOLD_FILE
thermedge_typeface_semibold_end:
    .section .note.GNU-stack, "", %progbits

/* The page that formats/page builds, as bytes of the tool that writes it. */
	.section .rodata
	.global mr_page_html
mr_page_html:
	.incbin "page.html"
	.byte 0
	.section .note.GNU-stack, "", %progbits

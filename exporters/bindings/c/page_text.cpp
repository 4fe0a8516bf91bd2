// SPDX-License-Identifier: BSD-3-Clause
// Hands out the text of pages.
#include "exporters/bindings/c/caller_memory.h"
#include "exporters/bindings/c/page.h"

meniscus_page* meniscus_page_retain(meniscus_page* page) { return meniscus::c_api::retain(page); }
void meniscus_page_release(meniscus_page* page) { meniscus::c_api::release(page); }

meniscus_status meniscus_page_html(const meniscus_page* page, const char** html, std::size_t* size) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(page, "page");
    require(html, "html");
    if (size) require(size, "size");
    *html = page->html.c_str();
    if (size) *size = page->html.size();
  });
}

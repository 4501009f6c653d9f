// SPDX-License-Identifier: Apache-2.0
// A camera: shows the frame list frames.tdf (layout in sim/verilated/frame_list.h) with the timing of 720p60, as
// sim/verilated/video_source.h does; sync pulses are active high, the data lines are unknown outside the picture.
// Writes "first <frame> <ns>" and "last <frame> <ns>" to `events` when a receiver takes these pixels.
`timescale 1ns / 1ps
`default_nettype none

module camera #(
    parameter H_FRONT = 110,
    parameter H_SYNC = 40,
    parameter H_BACK = 220,
    parameter V_FRONT = 5,
    parameter V_SYNC = 5,
    parameter V_BACK = 20
) (
    input  wire        pix_clk,
    input  wire        start,
    input  wire [31:0] events,
    output reg  [23:0] vid_data,
    output reg         vid_de,
    output reg         vid_hsync,
    output reg         vid_vsync,
    output reg  [31:0] width,
    output reg  [31:0] height,
    output reg  [31:0] count,
    output reg  [31:0] altitude_mm,
    output reg         finished
);

  localparam [31:0] MAGIC = "TDF1";
  localparam TOP = V_SYNC + V_BACK;

  integer file, frame, line, column;
  reg [31:0] word;
  reg [23:0] pixel;
  reg        visible;
  reg        first;
  reg        last;

  // $fread fills a register from its top; the list is little endian.
  task read_word;
    output [31:0] value;
    begin
      if ($fread(word, file) != 4) end_of_file;
      value = {word[7:0], word[15:8], word[23:16], word[31:24]};
    end
  endtask

  task end_of_file;
    begin
      $display("fault: frames.tdf ends within frame %0d", frame);
      $finish;
    end
  endtask

  task drive;
    begin
      @(posedge pix_clk);
      if (first) $fwrite(events, "first %0d %0d\n", frame, $time);
      if (last) $fwrite(events, "last %0d %0d\n", frame, $time);
      visible = line >= TOP && line < TOP + height && column < width;
      first = visible && line == TOP && column == 0;
      last = visible && line == TOP + height - 1 && column == width - 1;
      if (visible) if ($fread(pixel, file) != 3) end_of_file;
      vid_data <= visible ? pixel : 24'bx;
      vid_de <= visible;
      vid_hsync <= column >= width + H_FRONT && column < width + H_FRONT + H_SYNC;
      vid_vsync <= line < V_SYNC;
    end
  endtask

  initial begin
    finished = 1'b0;
    vid_de = 1'b0;
    vid_hsync = 1'b0;
    vid_vsync = 1'b0;
    first = 1'b0;
    last = 1'b0;
    frame = 0;
    file = $fopen("frames.tdf", "rb");
    if (file == 0) begin
      $display("fault: cannot read frames.tdf");
      $finish;
    end
    if ($fread(word, file) != 4) end_of_file;
    if (word != MAGIC) begin
      $display("fault: frames.tdf is not a frame list");
      $finish;
    end
    read_word(width);
    read_word(height);
    read_word(count);
    read_word(word);
    if (word != 1) begin
      $display("fault: frames.tdf shows each frame %0d times; this camera shows it once", word);
      $finish;
    end
    read_word(altitude_mm);
    wait (start);
    for (frame = 0; frame < count; frame = frame + 1) begin
      if (frame != 0) read_word(altitude_mm);
      for (line = 0; line < TOP + height + V_FRONT; line = line + 1)
        for (column = 0; column < width + H_FRONT + H_SYNC + H_BACK; column = column + 1) drive;
    end
    finished = 1'b1;
  end

endmodule

`default_nettype wire
